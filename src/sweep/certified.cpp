#include "sweep/certified.h"

#include <algorithm>

#include "sweep/error_bound.h"
#include "sweep/gap_line.h"
#include "sweep/support_plane.h"

namespace roam::certified {
namespace {

SweepResult hit_at(double time, const SupportPlane& plane, double distance) {
  return {true, time, plane.point, plane.normal, plane.feature, distance};
}

SweepResult miss(double t_end, double distance) { return {.hit = false, .time = t_end, .distance = distance}; }

}  // namespace

double hit_resolution(const Body& body, const Vec3& motion, const LocalTriangle& triangle, double t_end) noexcept {
  return hit_factor * error_bound(body, motion, triangle).at(t_end);
}

SweepResult sweep(const Body& body, const Vec3& motion, const LocalTriangle& triangle, double t_begin, double t_end,
                  double hit_tolerance) noexcept {
  const Obstacle obstacle(triangle.corner, body.half_height);
  const ErrorBound error = error_bound(body, motion, triangle);
  double time = t_begin;
  double gap = 0.0;
  SupportPlane plane{};
  for (int advance = 0; advance < advance_limit; ++advance) {
    const double doubt = error.at(time);
    plane = support_plane(obstacle, time * motion, doubt);
    const GapLine line(plane, body.radius, motion, error);
    gap = line.at(time);
    if (gap <= 0.0) return hit_at(time, plane, time == 0.0 ? gap : 0.0);
    if (line.slope >= 0.0) return miss(t_end, time == t_begin ? gap : 0.0);
    // Of the tolerance, the bound and the rounding of the closest points are spent already.
    if (gap <= std::max(arrival_factor * doubt, hit_tolerance - (hit_factor - arrival_factor) * doubt)) break;
    // The line certifies everything before its root; its rounding is part of the bound.
    time = line.at_zero / -line.slope;
    if (time >= t_end) return miss(t_end, std::max(0.0, line.at(t_end)));
  }
  return hit_at(time, plane, gap);
}

Proximity proximity(const Body& body, const LocalTriangle& triangle) noexcept {
  const Obstacle obstacle(triangle.corner, body.half_height);
  const double doubt = error_bound(body, Vec3(0.0), triangle).at_start;
  const SupportPlane plane = support_plane(obstacle, Vec3(0.0), doubt);
  return {plane.point, plane.normal, plane.feature, plane.offset - body.radius - doubt};
}

}  // namespace roam::certified
