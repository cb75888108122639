#include "view/surroundings.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace roam::app {

Vec3 gaze(double yaw, double pitch) {
  return {std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch)};
}

Surroundings surroundings(const osgRoam::Manipulator& roamer, const Space& visible,
                          const std::optional<Sightline>& ahead, std::span<const HalfSpace> hidden) {
  const Walker& walker = *roamer.walker();
  Surroundings found;
  found.feet = walker.feet();
  const Vec3 centre = walker.position();
  const Space& met = walker.space();
  if (const Impact floor = met.ray(centre, {0.0, 0.0, -sight(met, centre)}); floor.hit && !floor.unknown) {
    found.above_floor = std::max(0.0, found.feet.z - floor.point.z);
  }
  if (const auto seen = ahead ? seen_along(visible, *ahead, hidden) : std::nullopt) {
    found.ahead_m = glm::distance(seen->point, ahead->eye);
    found.ahead = seen->object;
  }
  return found;
}

}  // namespace roam::app
