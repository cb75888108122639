#include "osgroam/camera_pose.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "math/finite.h"

namespace osgRoam {
namespace {

using std::numbers::pi;

/// Cosine of the pitch. Below it the view is so steep that the up vector determines the yaw better than the direction.
constexpr double steep = 1e-5;

}  // namespace

double wrapped_yaw(double yaw) { return std::remainder(yaw, 2.0 * pi); }

double limited_pitch(double pitch) { return std::clamp(pitch, -0.5 * pi, 0.5 * pi); }

roam::Vec3 forward(double yaw, double pitch) {
  return {std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch)};
}

roam::Vec3 right(double yaw) { return {std::sin(yaw), -std::cos(yaw), 0.0}; }

osg::Matrixd camera_matrix(const CameraPose& pose, const osg::Vec3d& origin) {
  const roam::Vec3 f = forward(pose.yaw, pose.pitch), r = right(pose.yaw), u = glm::cross(r, f);
  const osg::Vec3d eye = to_osg(pose.eye) - origin;
  return {r.x, r.y, r.z, 0.0, u.x, u.y, u.z, 0.0, -f.x, -f.y, -f.z, 0.0, eye.x(), eye.y(), eye.z(), 1.0};
}

CameraPose looking_at(const roam::Vec3& eye, const roam::Vec3& center, const roam::Vec3& up) {
  const roam::Vec3 way = center - eye;
  const double length = glm::length(way);
  if (!(length > 0.0)) return {eye, 0.5 * pi, 0.0};  // along +y, like every manipulator of osgGA
  const roam::Vec3 f = way / length;
  const double level = std::hypot(f.x, f.y);
  const roam::Vec3 ahead = level > steep ? f : (f.z < 0.0 ? up : -up);
  return {eye, std::atan2(ahead.y, ahead.x), std::atan2(f.z, level)};
}

std::optional<CameraPose> camera_pose(const osg::Matrixd& matrix, const osg::Vec3d& origin) {
  const roam::Vec3 up(matrix(1, 0), matrix(1, 1), matrix(1, 2)), back(matrix(2, 0), matrix(2, 1), matrix(2, 2));
  const roam::Vec3 eye = to_roam(matrix.getTrans() + origin);
  if (!roam::is_within_limit(eye) || !std::isfinite(glm::length(up)) || !(glm::length(back) > 0.0) ||
      !std::isfinite(glm::length(back))) {
    return std::nullopt;
  }
  CameraPose pose = looking_at(roam::Vec3(0.0), -back, up);
  pose.eye = eye;
  return pose;
}

std::optional<roam::Vec3> through_picture(const CameraPose& pose, const osg::Matrixd& projection, double x, double y) {
  const bool perspective = projection(3, 3) == 0.0 && projection(2, 3) == -1.0;
  if (!perspective || projection(0, 0) == 0.0 || projection(1, 1) == 0.0) return std::nullopt;
  const double across = (x + projection(2, 0)) / projection(0, 0), above = (y + projection(2, 1)) / projection(1, 1);
  const roam::Vec3 f = forward(pose.yaw, pose.pitch), r = right(pose.yaw), u = glm::cross(r, f);
  return glm::normalize(f + across * r + above * u);
}

}  // namespace osgRoam
