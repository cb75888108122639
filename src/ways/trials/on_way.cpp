#include "ways/trials/on_way.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace roam::ways {
namespace {

/// Metres: points this far above or below the feet are on the same storey.
constexpr double storey_above = 3.0;
constexpr double storey_below = 1.0;

}  // namespace

OnWay nearest_on(std::span<const Vec3> way, const Vec3& point, Mode mode) {
  const Vec3 counts(1.0, 1.0, mode == Mode::walk ? 0.0 : 1.0);
  OnWay best;
  double gone = 0.0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const Vec3 run = i + 1 < way.size() ? way[i + 1] - way[i] : Vec3(0.0);
    const Vec3 seen = run * counts;
    const double square = glm::dot(seen, seen), length = glm::length(run);
    const double part = square > 0.0 ? std::clamp(glm::dot(point - way[i], seen) / square, 0.0, 1.0) : 0.0;
    Vec3 off = point - (way[i] + part * run);
    if (mode == Mode::walk) off.z -= std::clamp(off.z, -storey_below, storey_above);
    const double apart = glm::length(off);
    if (apart < best.apart) {
      const Vec3 heading = length > 0.0 ? run / length : best.heading;
      best = {gone + part * length, apart, way[i] + part * run, heading};
    }
    gone += length;
  }
  return best;
}

}  // namespace roam::ways
