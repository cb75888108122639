#include "view/surroundings.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace roam::app {

Vec3 gaze(double yaw, double pitch) {
  return {std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch)};
}

double sight(const Space& space, const Vec3& eye) {
  constexpr double farthest = 1e5;
  const Box box = space.bounds();
  return box.empty() ? 0.0 : std::min(glm::distance(eye, box.center()) + glm::length(box.size()), farthest);
}

Surroundings surroundings(const osgRoam::Manipulator& roamer, const Space& space) {
  const Walker& walker = *roamer.walker();
  Surroundings found;
  found.feet = walker.feet();
  const Vec3 centre = walker.position(), eye = roamer.eye();
  const double drop = sight(space, centre);
  if (const Impact floor = space.ray(centre, {0.0, 0.0, -drop}); floor.hit && !floor.unknown) {
    found.above_floor = std::max(0.0, found.feet.z - floor.point.z);
  }
  if (const Impact seen = space.ray(eye, sight(space, eye) * gaze(roamer.yaw(), roamer.pitch()));
      seen.hit && !seen.unknown) {
    found.ahead_m = glm::distance(seen.point, eye);
    found.ahead = space.object_name(seen.triangle);
  }
  return found;
}

}  // namespace roam::app
