#pragma once
/// \file
/// The certified gap of one supporting plane, over time.

#include <algorithm>
#include <cmath>

#include "sweep/certified.h"
#include "sweep/error_bound.h"
#include "sweep/support_plane.h"

namespace roam::certified {

/// The bound of docs/algorithm.md, "Error bound", for a body that starts at the frame's origin.
[[nodiscard]] inline ErrorBound error_bound(const Body& body, const Vec3& motion, const LocalTriangle& triangle) {
  const auto taxicab = [](const Vec3& x) { return std::abs(x.x) + std::abs(x.y) + std::abs(x.z); };
  const double corners =
      std::max({taxicab(triangle.corner[0]), taxicab(triangle.corner[1]), taxicab(triangle.corner[2])});
  constexpr double relative = roundings * unit_roundoff;
  return {relative * (corners + body.half_height + body.radius) + corner_error_factor * triangle.corner_error +
              underflow_floor,
          relative * taxicab(motion)};
}

/// A lower bound of the gap between body and triangle, affine in time, with the error bound subtracted. Where it is >=
/// 0, the body is free in exact arithmetic.
struct GapLine {
  GapLine(const SupportPlane& plane, double radius, const Vec3& motion, const ErrorBound& error)
      : at_zero(plane.offset - radius - error.at_start), slope(glm::dot(plane.normal, motion) - error.per_time) {}

  [[nodiscard]] double at(double time) const { return at_zero + time * slope; }

  double at_zero;  ///< m, at time 0
  double slope;    ///< m for the whole motion
};

}  // namespace roam::certified
