#pragma once
/// \file
/// Balls that stand on one point, their lowest. The smaller lies in the larger.

#include <limits>

namespace roam {

/// The radius of the ball that just touches another point: `above` the lowest one, and so far aside of it that the
/// square is `aside_squared`. Infinite where it is not above.
[[nodiscard]] inline double nested_ball(double aside_squared, double above) {
  return above > 0.0 ? (aside_squared + above * above) / (2.0 * above) : std::numeric_limits<double>::infinity();
}

}  // namespace roam
