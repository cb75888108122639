#include "view/pick.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "osgroam/vectors.h"

namespace roam::app {
namespace {

/// The part of the segment from `from` to `from + motion` that the planes do not hide, as two fractions; the second is
/// smaller than the first if there is none.
std::pair<double, double> seen_part(std::span<const HalfSpace> planes, const Vec3& from, const Vec3& motion) {
  double first = 0.0, last = 1.0;
  for (const auto& [normal, distance] : planes) {
    const double over = glm::dot(normal, from) - distance, rise = glm::dot(normal, motion);
    if (rise < 0.0) {
      first = std::max(first, -over / rise);
    } else if (rise > 0.0) {
      last = std::min(last, -over / rise);
    } else if (over > 0.0) {
      last = -1.0;
    }
  }
  return {first, last};
}

}  // namespace

double slope_degrees(const Pick& pick) {
  return glm::degrees(std::acos(std::clamp(std::abs(pick.normal.z), 0.0, 1.0)));
}

std::optional<Sightline> sightline(const CameraView& camera, double x, double y) {
  const osg::Matrixd to_graph = osg::Matrixd::inverse(camera.view);
  const osg::Vec3d ahead = osg::Vec3d(x, y, -1.0) * osg::Matrixd::inverse(camera.projection);
  const Vec3 eye = osgRoam::to_roam(to_graph.getTrans()) + camera.origin;
  const Vec3 direction = osgRoam::to_roam(osg::Matrixd::transform3x3(ahead, to_graph));
  const double length = glm::length(direction);
  if (!(length > 0.0) || !std::isfinite(length) || !std::isfinite(glm::length(eye))) return std::nullopt;
  return Sightline{eye, direction / length};
}

std::optional<std::array<double, 2>> seen_at(const CameraView& camera, const Vec3& point) {
  const Vec3 p = point - camera.origin;
  const osg::Vec4d clip = osg::Vec4d(p.x, p.y, p.z, 1.0) * camera.view * camera.projection;
  if (!(clip.w() > 0.0)) return std::nullopt;
  return std::array{clip.x() / clip.w(), clip.y() / clip.w()};
}

double sight(const Space& space, const Vec3& eye) {
  constexpr double farthest = 1e5;
  const Box box = space.bounds();
  return box.empty() ? 0.0 : std::min(glm::distance(eye, box.center()) + glm::length(box.size()), farthest);
}

std::optional<Pick> seen_along(const Space& space, const Sightline& line, std::span<const HalfSpace> hidden) {
  const Vec3 whole = sight(space, line.eye) * line.direction;
  const auto [first, last] = seen_part(hidden, line.eye, whole);
  if (!(first < last)) return std::nullopt;
  const Impact seen = space.ray(line.eye + first * whole, (last - first) * whole);
  if (!seen.hit || seen.unknown) return std::nullopt;
  return Pick{seen.point, seen.normal, space.object_name(seen.triangle), seen.triangle};
}

std::optional<Pick> pick(const Space& space, const CameraView& camera, double x, double y,
                         std::span<const HalfSpace> hidden) {
  const auto line = sightline(camera, x, y);
  return line ? seen_along(space, *line, hidden) : std::nullopt;
}

}  // namespace roam::app
