#include "measure/slope.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <vector>

#include "math/floating_point.h"

namespace roam::measure {
namespace {

/// The position at a distance along the way, seen from above. `at` is ascending, and so is `i` from call to call.
Vec3 position(std::span<const Vec3> way, const std::vector<double>& at, double distance, std::size_t& i) {
  while (i + 2 < way.size() && at[i + 1] < distance) ++i;
  const double length = at[i + 1] - at[i];
  const double t = length > 0.0 ? std::clamp((distance - at[i]) / length, 0.0, 1.0) : 0.0;
  return way[i] + t * (way[i + 1] - way[i]);
}

}  // namespace

Slope steepest(std::span<const Vec3> way, double over) {
  const DefaultFloatingPoint guard;
  Slope slope;
  if (way.size() < 2) return slope;
  std::vector<double> at{0.0};
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Vec3 part = way[i] - way[i - 1];
    at.push_back(at.back() + std::hypot(part.x, part.y));
    (part.z > 0.0 ? slope.rise : slope.fall) += std::abs(part.z);
  }
  const double length = at.back();
  if (!(length > 0.0)) {
    slope.degrees = slope.rise + slope.fall > 0.0 ? 90.0 : 0.0;
    slope.place = 0.5 * (way.front() + way.back());
    return slope;
  }
  const double window = std::min(over, length);
  // A straight part's difference of heights changes evenly as the window moves: it is largest where an end of the
  // window is at a corner.
  std::vector<double> begins{0.0, length - window};
  for (const double corner : at) {
    if (corner + window <= length) begins.push_back(corner);
    if (corner >= window) begins.push_back(corner - window);
  }
  std::sort(begins.begin(), begins.end());
  std::size_t from = 0, to = 0;
  for (const double begin : begins) {
    const Vec3 a = position(way, at, begin, from), b = position(way, at, begin + window, to);
    const double degrees = glm::degrees(std::atan2(std::abs(b.z - a.z), window));
    if (degrees <= slope.degrees) continue;
    slope.degrees = degrees;
    slope.place = 0.5 * (a + b);
  }
  return slope;
}

std::optional<double> slope_below(const Space& space, const Body& body, const Vec3& centre) {
  constexpr double reach = 0.05;  // m
  const Impact below = space.sweep(body, centre, {0.0, 0.0, -reach});
  if (!below.hit || below.unknown || below.feature != Feature::face) return std::nullopt;
  return glm::degrees(std::acos(std::clamp(below.normal.z, 0.0, 1.0)));
}

}  // namespace roam::measure
