#include <algorithm>
#include <cassert>
#include <limits>

#include "sweep/certified.h"
#include "sweep/face_plane.h"
#include "sweep/gap_line.h"

namespace roam::certified {
namespace {

/// True if the foot of the centre on the face certainly lies in the triangle: along n, the centre is farther inside of
/// each edge than `doubt`, the error bound at its time.
///
/// Let R be the 1-norms of centre and corner. In unit roundoffs of |n| |edge| R, the side of an edge carries one
/// rounding each of the centre, the edge and the difference, 2 of the cross product and 3 of the dot product. The terms
/// of a cross product add up to at most 2/sqrt(3) of the lengths: 8 * 2/sqrt(3) < 9.3 of the 16 in `doubt`. The rest of
/// `doubt` is as far as a corner's own error moves it, so that the true triangle contains the foot, too.
bool is_inside(const FacePlane& plane, const LocalTriangle& triangle, const Vec3& centre, double doubt) {
  const Vec3(&v)[3] = triangle.corner;
  double inside = std::numeric_limits<double>::infinity(), longest = 0.0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 edge = v[(i + 1) % 3] - v[i];
    inside = std::min(inside, glm::dot(plane.normal, glm::cross(edge, centre - v[i])));
    longest = std::max(longest, glm::dot(edge, edge));
  }
  return inside > 0.0 && inside * inside > doubt * doubt * plane.square * longest;
}

}  // namespace

double sphere_impact_time(const Body& body, const Vec3& motion, const LocalTriangle& triangle, double t_begin,
                          double t_end, double hit_tolerance) noexcept {
  assert(body.half_height == 0.0);
  const ErrorBound error = error_bound(body, motion, triangle);
  const FacePlane plane(body, motion, triangle, error);
  double free = t_begin;
  if (plane.is_known() && plane.slack > t_begin * plane.speed) {
    if (plane.speed <= 0.0 || plane.slack >= t_end * plane.speed) return t_end;
    free = plane.slack / plane.speed;
    const double doubt = error.at(free);
    // If the foot lies in the triangle, its distance is at most that of the plane through the farthest corner.
    const bool arrived = is_inside(plane, triangle, free * motion, doubt) &&
                         plane.depth <= plane.length * (hit_tolerance - hit_factor * doubt);
    if (arrived) return free;
  }
  const SweepResult swept = sweep(body, motion, triangle, free, t_end, hit_tolerance);
  return swept.hit ? swept.time : t_end;
}

}  // namespace roam::certified
