#include "measure/slope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <utility>
#include <vector>

#include "math/floating_point.h"

namespace roam::measure {
namespace {

/// A part of the length of a way. Distances along it are rounded by less.
constexpr double rounding = 1e-12;

/// The lowest and the highest position at a distance along the way, seen from above: two where the way is vertical.
/// `at` is ascending, and so is `i` from call to call.
std::array<Vec3, 2> positions(std::span<const Vec3> way, const std::vector<double>& at, double distance,
                              std::size_t& i) {
  const double slack = rounding * at.back();
  const auto position = [&](std::size_t k, double in_vertical) {
    const double length = at[k + 1] - at[k];
    const double t = length > 0.0 ? std::clamp((distance - at[k]) / length, 0.0, 1.0) : in_vertical;
    return way[k] + t * (way[k + 1] - way[k]);
  };
  while (i + 2 < way.size() && at[i + 1] < distance - slack) ++i;
  std::array<Vec3, 2> ends{position(i, 0.0), position(i, 1.0)};
  if (ends[1].z < ends[0].z) std::swap(ends[0], ends[1]);
  for (std::size_t k = i + 1; k + 1 < way.size() && at[k] <= distance + slack; ++k) {
    const Vec3 next = position(k, 1.0);
    if (next.z < ends[0].z) ends[0] = next;
    if (next.z > ends[1].z) ends[1] = next;
  }
  return ends;
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
    const auto ends = positions(way, at, begin + window, to);
    for (const Vec3& a : positions(way, at, begin, from)) {
      for (const Vec3& b : ends) {
        const double degrees = glm::degrees(std::atan2(std::abs(b.z - a.z), window));
        if (degrees <= slope.degrees) continue;
        slope.degrees = degrees;
        slope.place = 0.5 * (a + b);
      }
    }
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
