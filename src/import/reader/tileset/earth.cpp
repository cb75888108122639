#include "import/reader/tileset/earth.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string_view>

#include "import/reader/numbers.h"

namespace roam::reader {
namespace {

// WGS 84 (NGA.STND.0036).
constexpr double equatorial_radius = 6378137.0;  ///< metres
constexpr double flattening = 1.0 / 298.257223563;
constexpr double eccentricity_2 = flattening * (2.0 - flattening);
constexpr double degree = std::numbers::pi / 180.0;

/// Radius of curvature in the prime vertical.
double prime_vertical(double sine) { return equatorial_radius / std::sqrt(1.0 - eccentricity_2 * sine * sine); }

}  // namespace

Geodetic geodetic(const Vec3& p) {
  const double from_axis = std::hypot(p.x, p.y);
  Geodetic place;
  place.longitude = std::atan2(p.y, p.x);
  place.latitude = std::atan2(p.z, from_axis * (1.0 - eccentricity_2));
  // Each step shrinks the error some 300 times.
  for (int i = 0; i < 6; ++i) {
    const double sine = std::sin(place.latitude);
    place.latitude = std::atan2(p.z + eccentricity_2 * prime_vertical(sine) * sine, from_axis);
  }
  const double sine = std::sin(place.latitude), cosine = std::cos(place.latitude);
  place.height = from_axis * cosine + p.z * sine - equatorial_radius * std::sqrt(1.0 - eccentricity_2 * sine * sine);
  return place;
}

Vec3 earth_centred(const Geodetic& place) {
  const double sine = std::sin(place.latitude), cosine = std::cos(place.latitude);
  const double radius = prime_vertical(sine);
  return {(radius + place.height) * cosine * std::cos(place.longitude),
          (radius + place.height) * cosine * std::sin(place.longitude),
          (radius * (1.0 - eccentricity_2) + place.height) * sine};
}

glm::dmat4 axes_at(const Geodetic& place) {
  const double sine = std::sin(place.latitude), cosine = std::cos(place.latitude);
  const Vec3 up(cosine * std::cos(place.longitude), cosine * std::sin(place.longitude), sine);
  const Vec3 east(-std::sin(place.longitude), std::cos(place.longitude), 0.0);
  return {glm::dvec4(east, 0.0), glm::dvec4(glm::cross(up, east), 0.0), glm::dvec4(up, 0.0), glm::dvec4(0, 0, 0, 1)};
}

LocalFrame::LocalFrame(double latitude, double longitude) : latitude_(latitude), longitude_(longitude) {
  const double sine = std::sin(latitude * degree);
  const double radius = prime_vertical(sine);
  const glm::dmat4 axes = axes_at({latitude * degree, longitude * degree, 0.0});
  east_ = Vec3(axes[0]);
  north_ = Vec3(axes[1]);
  up_ = Vec3(axes[2]);
  origin_ = {radius * up_.x, radius * up_.y, radius * (1.0 - eccentricity_2) * sine};
}

LocalFrame LocalFrame::near(const Geodetic& place) {
  const auto hundredths = [](double radians) { return std::round(radians / degree * 100.0) / 100.0; };
  // No negative zeros, which the srs would show.
  return {hundredths(place.latitude) + 0.0, hundredths(place.longitude) + 0.0};
}

std::optional<LocalFrame> LocalFrame::of(const std::string& srs) {
  constexpr std::string_view start = "ENU:";
  const std::string_view text = srs;
  const std::size_t comma = text.find(',');
  if (!text.starts_with(start) || comma == std::string_view::npos) return std::nullopt;
  double latitude = 0.0, longitude = 0.0;
  if (!parse(trimmed(text.substr(start.size(), comma - start.size())), latitude) ||
      !parse(trimmed(text.substr(comma + 1)), longitude) || !(std::abs(latitude) <= 90.0) ||
      !(std::abs(longitude) <= 360.0)) {
    return std::nullopt;
  }
  return LocalFrame(latitude, longitude);
}

std::string LocalFrame::srs() const { return fmt::format("ENU:{},{}", latitude_, longitude_); }

glm::dmat4 LocalFrame::local(const glm::dmat4& m) const {
  glm::dmat4 result(0.0);
  for (int column = 0; column < 4; ++column) {
    // The difference first: two large coordinates that are near each other lose nothing.
    const Vec3 v = column == 3 ? Vec3(m[3]) - origin_ : Vec3(m[column]);
    result[column] = glm::dvec4(glm::dot(east_, v), glm::dot(north_, v), glm::dot(up_, v), m[column][3]);
  }
  return result;
}

}  // namespace roam::reader
