#include <algorithm>
#include <cmath>

#include "sweep/bracket.h"
#include "sweep/error_bound.h"
#include "sweep/gap_line.h"
#include "sweep/support_plane.h"

namespace roam::certified {
namespace {

/// The signed distance at one time, and the plane that bounds it from below at all times.
struct Sample {
  double time;
  SupportPlane plane;
  double distance;  ///< m, without the error bound
  double slope;     ///< m for the whole motion

  /// Half the derivative of the squared distance. It is piecewise linear in time, so that a secant finds its root.
  [[nodiscard]] double pull() const { return distance > 0.0 ? distance * slope : slope; }
};

double secant(const Sample& left, const Sample& right) {
  return left.time + (right.time - left.time) * (left.pull() / (left.pull() - right.pull()));
}

}  // namespace

Approach approach(const Body& body, const Vec3& motion, const LocalTriangle& triangle, double t_begin,
                  double t_end) noexcept {
  Obstacle obstacle(triangle.corner, body.half_height);
  const ErrorBound error = error_bound(body, motion, triangle);
  const double doubt = error.at(t_end);
  const auto sample = [&](double time) {
    const Vec3 centre = time * motion;
    const SupportPlane plane = support_plane(obstacle, centre, doubt);
    return Sample{time, plane, plane.value(centre), glm::dot(plane.normal, motion)};
  };
  const auto answer = [&](const Sample& s, double lower) {
    // One bound for the planes, one for the arithmetic between them.
    const double certified = lower - body.radius - 2.0 * doubt;
    return Approach{s.time, {s.plane.point, s.plane.normal, s.plane.feature, certified}};
  };

  Sample left = sample(t_begin);
  if (left.slope >= 0.0 || t_end <= t_begin) return answer(left, left.distance);
  Sample right = sample(t_end);
  if (right.slope <= 0.0) return answer(right, right.distance);
  const Crossing lower = narrow(
      left, right, advance_limit, sample,
      // The secant is exact once both samples share a feature. The crossing and the midpoint ensure that neither side
      // of the bracket stands still for long.
      [&](int step, const Crossing& c) {
        const double guess[] = {secant(left, right), c.time, 0.5 * (left.time + right.time)};
        return guess[step % 3];
      },
      [&](const Crossing& c) {
        const Sample& least = left.distance <= right.distance ? left : right;
        return least.distance - c.distance <= std::max(approach_tolerance * std::abs(least.distance), doubt);
      });
  return left.distance <= right.distance ? answer(left, lower.distance) : answer(right, lower.distance);
}

}  // namespace roam::certified
