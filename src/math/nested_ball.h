#pragma once
/// \file
/// Balls that share their lowest point. A smaller ball lies inside a larger one.

#include <limits>

namespace roam {

/// The radius of the ball through another point that is `above` the lowest point. `aside_squared` is the square of the
/// horizontal distance between the two. Infinite if `above` is not positive.
[[nodiscard]] inline double nested_ball(double aside_squared, double above) {
  return above > 0.0 ? (aside_squared + above * above) / (2.0 * above) : std::numeric_limits<double>::infinity();
}

}  // namespace roam
