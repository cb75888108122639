#include "view/section_grips.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace roam::app {
namespace {

constexpr double drawn_share = 0.018;   // radius of a grip, of its distance from the eye
constexpr double caught_share = 1.6;    // of that radius: what the mouse catches
constexpr double farthest_drag = 50.0;  // distances of the grip from the eye

/// How far along the axis, through the grip, a line of sight comes nearest to it; none along the axis.
std::optional<double> along(int axis, const Vec3& grip, const Sightline& line) {
  constexpr double least_sine_squared = 1e-3;
  const Vec3 way = line.eye - grip;
  const double cosine = line.direction[axis];
  const double sine_squared = 1.0 - cosine * cosine;
  if (sine_squared < least_sine_squared) return std::nullopt;
  const double most = farthest_drag * glm::length(way);
  return std::clamp((way[axis] - cosine * glm::dot(line.direction, way)) / sine_squared, -most, most);
}

/// Where a line of sight meets the plane through `place` across the view; none beside it.
std::optional<Vec3> across(const Vec3& place, const Vec3& ahead, const Sightline& line) {
  const double rise = glm::dot(line.direction, ahead);
  if (rise < 1e-3) return std::nullopt;
  return line.eye + glm::dot(place - line.eye, ahead) / rise * line.direction;
}

/// Moves one side by `by` along +axis.
void move_side(Box& box, Grip side, double by, double least) {
  const int axis = static_cast<int>(side / 2);
  double& moved = side % 2 == 0 ? box.lower[axis] : box.upper[axis];
  moved += by;
  if (side % 2 == 0) {
    moved = std::min(moved, box.upper[axis] - least);
  } else {
    moved = std::max(moved, box.lower[axis] + least);
  }
}

double radius_of(const Vec3& place, const Vec3& eye) { return drawn_share * glm::distance(place, eye); }

Vec3 eye_of(const CameraView& camera) {
  const osg::Vec3d eye = osg::Matrixd::inverse(camera.view).getTrans();
  return Vec3(eye.x(), eye.y(), eye.z()) + camera.origin;
}

}  // namespace

Vec3 place_of(Grip grip, const Box& box) {
  Vec3 place = box.center();
  if (grip != middle_grip) {
    const int axis = static_cast<int>(grip / 2);
    place[axis] = grip % 2 == 0 ? box.lower[axis] : box.upper[axis];
  }
  return place;
}

std::optional<Grip> grip_at(const Box& box, const CameraView& camera, double x, double y) {
  const auto line = sightline(camera, x, y);
  if (!line) return std::nullopt;
  std::optional<Grip> found;
  double nearest = std::numeric_limits<double>::infinity();
  for (Grip grip = 0; grip < grip_count; ++grip) {
    const Vec3 place = place_of(grip, box), way = place - line->eye;
    const double forward = glm::dot(way, line->direction);
    if (forward <= 0.0 || forward >= nearest) continue;
    if (glm::length(way - forward * line->direction) > caught_share * radius_of(place, line->eye)) continue;
    found = grip;
    nearest = forward;
  }
  return found;
}

Box dragged(const Box& box, Grip grip, const Sightline& from, const Sightline& to, const Vec3& ahead, double least) {
  Box moved = box;
  const Vec3 place = place_of(grip, box);
  if (grip == middle_grip) {
    const auto a = across(place, ahead, from), b = across(place, ahead, to);
    if (a && b) moved = {box.lower + (*b - *a), box.upper + (*b - *a)};
    return moved;
  }
  const int axis = static_cast<int>(grip / 2);
  const auto a = along(axis, place, from), b = along(axis, place, to);
  if (a && b) move_side(moved, grip, *b - *a, least);
  return moved;
}

Box grown_at(Grip grip, const Box& box, double by, double least) {
  Box moved = box;
  for (Grip side = 0; side < middle_grip; ++side) {
    if (grip != middle_grip && grip != side) continue;
    // Two sides that meet share what is left.
    const int axis = static_cast<int>(side / 2);
    const double room = box.size()[axis] - least;
    const double step = grip == middle_grip ? std::max(by, -0.5 * room) : by;
    move_side(moved, side, side % 2 == 0 ? -step : step, least);
  }
  return moved;
}

graphics::BoxMark mark_of(const Box& box, const CameraView& camera, std::optional<Grip> held) {
  const Vec3 eye = eye_of(camera);
  graphics::BoxMark mark{{box.lower - camera.origin, box.upper - camera.origin}, {}};
  for (Grip grip = 0; grip < grip_count; ++grip) {
    const Vec3 place = place_of(grip, box);
    mark.grips.push_back({place - camera.origin, radius_of(place, eye), grip == held});
  }
  return mark;
}

}  // namespace roam::app
