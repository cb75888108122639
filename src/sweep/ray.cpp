#include <algorithm>
#include <cmath>
#include <limits>

#include "sweep/certified.h"
#include "sweep/error_bound.h"
#include "sweep/gap_line.h"

namespace roam::certified {

// The certified gap is that of plane_separates(), times |n|: the same count of roundings holds, with one more for the
// quotient.
double sweep_ray(const Body& body, const Vec3& motion, const LocalTriangle& triangle, double t_begin, double t_end,
                 double hit_tolerance) noexcept {
  const Vec3(&v)[3] = triangle.corner;
  const Vec3 edge[3] = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  const Vec3 n = glm::cross(edge[0], edge[1]);
  const double square = glm::dot(n, n), length = std::sqrt(square);
  const auto [least, most] = std::minmax({glm::dot(n, v[0]), glm::dot(n, v[1]), glm::dot(n, v[2])});
  const ErrorBound error = error_bound(body, motion, triangle);
  const double way = glm::dot(n, motion);
  // The body starts on that side of the plane where the gap is positive.
  const double slack = std::max(least, -most) - length * (body.radius + error.at_start);
  const double speed = (least > -most ? way : -way) + length * error.per_time;
  double free = t_begin;
  if (square > shortest_squared && slack > t_begin * std::max(speed, 0.0)) {
    if (speed <= 0.0 || slack >= t_end * speed) return t_end;
    free = slack / speed;
    const Vec3 centre = free * motion;
    const double doubt = error.at(free);
    double inside = std::numeric_limits<double>::infinity(), longest = 0.0;
    for (int i = 0; i < 3; ++i) {
      inside = std::min(inside, glm::dot(n, glm::cross(edge[i], centre - v[i])));
      longest = std::max(longest, glm::dot(edge[i], edge[i]));
    }
    // The foot of the centre certainly lies on the face, so the distance is at most that to the farthest corner's
    // plane.
    const bool on_face = inside > 0.0 && inside * inside > doubt * doubt * square * longest;
    if (on_face && most - least <= length * (hit_tolerance - hit_factor * doubt)) return free;
  }
  const SweepResult swept = sweep(body, motion, triangle, free, t_end, hit_tolerance);
  return swept.hit ? swept.time : t_end;
}

}  // namespace roam::certified
