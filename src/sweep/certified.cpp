#include "sweep/certified.h"

#include <algorithm>
#include <cmath>

#include "sweep/error_bound.h"
#include "sweep/gap_line.h"
#include "sweep/support_plane.h"

namespace roam::certified {
namespace {

SweepResult hit_at(double time, const SupportPlane& plane, double distance) {
  return {true, time, plane.point, plane.normal, plane.feature, distance};
}

SweepResult miss(double t_end, double distance) { return {.hit = false, .time = t_end, .distance = distance}; }

/// The time of the next sample: when the distance to the feature that is closest now would reach the radius, or its
/// minimum if it never does. A guess affects only speed, because every plane is a valid bound.
double aim(const SupportPlane& plane, double time, double radius, const Vec3& motion) {
  const double distance = plane.value(time * motion), slope = glm::dot(plane.normal, motion);
  Vec3 turning = motion;
  if (const double square = glm::dot(plane.straight, plane.straight); square > 0.0) {
    turning -= plane.straight * (glm::dot(plane.straight, motion) / square);
  }
  // Squared distance at time + s: distance^2 - 2 s half + s^2 whole.
  const double whole = glm::dot(turning, turning), half = -distance * slope;
  const double rest = (distance - radius) * (distance + radius);
  const double discriminant = half * half - whole * rest;
  return time + (discriminant > 0.0 ? rest / (half + std::sqrt(discriminant)) : half / whole);
}

}  // namespace

SweepResult sweep(const Body& body, const Vec3& motion, const LocalTriangle& triangle, double t_begin, double t_end,
                  double hit_tolerance) noexcept {
  Obstacle obstacle(triangle.corner, body.half_height);
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
    // The tolerance has already paid for the error bound and the rounding of the closest points.
    if (gap <= std::max(arrival_factor * doubt, hit_tolerance - (hit_factor - arrival_factor) * doubt)) break;
    // The line certifies everything before its root; its rounding is part of the bound.
    const double next = line.at_zero / -line.slope;
    if (next >= t_end) return miss(t_end, std::max(0.0, line.at(t_end)));
    if (plane.feature != Feature::face) {
      const double guess = std::min(aim(plane, time, body.radius + error.at(t_end), motion), t_end);
      if (guess > next) {
        const GapLine ahead(support_plane(obstacle, guess * motion, doubt), body.radius, motion, error);
        const double root = ahead.at_zero / -ahead.slope;
        if (ahead.slope >= 0.0 ? root <= next : root >= t_end) return miss(t_end, 0.0);
        if (ahead.slope < 0.0 && root > next) {
          time = root;
          continue;
        }
      }
    }
    time = next;
  }
  return hit_at(time, plane, gap);
}

Proximity proximity(const Body& body, const LocalTriangle& triangle) noexcept {
  Obstacle obstacle(triangle.corner, body.half_height);
  const double doubt = error_bound(body, Vec3(0.0), triangle).at_start;
  const SupportPlane plane = support_plane(obstacle, Vec3(0.0), doubt);
  return {plane.point, plane.normal, plane.feature, plane.offset - body.radius - doubt};
}

}  // namespace roam::certified
