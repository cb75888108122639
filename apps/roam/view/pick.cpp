#include "view/pick.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "osgroam/vectors.h"
#include "view/surroundings.h"

namespace roam::app {

double slope_degrees(const Pick& pick) {
  return glm::degrees(std::acos(std::clamp(std::abs(pick.normal.z), 0.0, 1.0)));
}

std::optional<Pick> pick(const Space& space, const osg::Matrixd& view, const osg::Matrixd& projection,
                         const Vec3& origin, double x, double y) {
  const osg::Matrixd to_graph = osg::Matrixd::inverse(view);
  const osg::Vec3d ahead = osg::Vec3d(x, y, -1.0) * osg::Matrixd::inverse(projection);
  const Vec3 eye = osgRoam::to_roam(to_graph.getTrans()) + origin;
  const Vec3 direction = osgRoam::to_roam(osg::Matrixd::transform3x3(ahead, to_graph));
  const double length = glm::length(direction);
  if (!(length > 0.0) || !std::isfinite(length) || !std::isfinite(glm::length(eye))) return std::nullopt;
  const Impact seen = space.ray(eye, sight(space, eye) / length * direction);
  if (!seen.hit || seen.unknown) return std::nullopt;
  return Pick{seen.point, seen.normal, space.object_name(seen.triangle), seen.triangle};
}

}  // namespace roam::app
