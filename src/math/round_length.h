#pragma once
/// \file
/// Round lengths, for scales.

#include <cmath>

namespace roam {

/// The largest of 1, 2, 5, 10, 20, 50, ... and 0.5, 0.2, ... that is at most `limit` (> 0).
[[nodiscard]] inline double round_length(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit)));
  constexpr double rounding = 1e-9;
  for (const double digit : {10.0, 5.0, 2.0}) {
    if (digit * power <= limit * (1.0 + rounding)) return digit * power;
  }
  return power;
}

}  // namespace roam
