#pragma once
/// \file
/// The rounding-error bound of the certified sweep: all constants of its proof. docs/algorithm.md, "Error bound",
/// counts the roundings.

#include <cfloat>
#include <limits>

namespace roam::certified {

static_assert(std::numeric_limits<double>::is_iec559 && FLT_EVAL_METHOD == 0,
              "the error bound counts the roundings of IEEE doubles");

/// Unit roundoff of IEEE double, round to nearest (Higham, "Accuracy and Stability of Numerical Algorithms", 2.2).
inline constexpr double unit_roundoff = 0x1p-53;

/// Roundings charged to each metre of the reach (corners, motion, half height, radius). 12 are counted; the rest
/// covers second-order terms and the rounding of the bound itself.
inline constexpr double roundings = 16.0;

/// sqrt(3), rounded up: a corner moves at most this many times the error of its coordinates along a unit normal.
inline constexpr double corner_error_factor = 1.7320508075688774;

/// Metres. Covers underflow in the products, so that the bound is never zero.
inline constexpr double underflow_floor = std::numeric_limits<double>::min();

/// In error bounds at the current time. A body whose certified gap is no more than this has arrived: below it an
/// advance is no longer sure to halve the rest (docs/algorithm.md, "Termination").
inline constexpr double arrival_factor = 4.0;

/// In error bounds. A hit with tolerance 0 lies within this many bounds of the radius. It is arrival_factor plus one
/// each for the bound that was subtracted, the accepted gap between lower bound and distance, the rounding of the
/// closest point, and the triangle's own error.
inline constexpr double hit_factor = arrival_factor + 4.0;

/// Directions with a smaller square (m^2; m^4 for a face) have no reliable length: the square has lost digits to
/// underflow. They are skipped; the distances they could resolve are below 1e-65 m.
inline constexpr double shortest_squared = 1e-260;

/// Advances in one sweep. The proof allows 116; tests see at most 11. A sweep that reached the limit would stop too
/// early, never too late.
inline constexpr int advance_limit = 128;

/// The error to subtract from a computed support value, in metres, as a function of time in [0, 1].
struct ErrorBound {
  double at_start;  ///< m
  double per_time;  ///< m for the whole motion

  [[nodiscard]] double at(double time) const { return at_start + time * per_time; }
};

}  // namespace roam::certified
