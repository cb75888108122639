#pragma once
/// \file
/// The slope limit of floors.

#include <cmath>
#include <numbers>

namespace roam {

/// Tolerance for the z of a unit normal, so that a ramp exactly at the slope limit is floor.
inline constexpr double cosine_rounding = 1e-9;

/// The least z of the unit normal of a floor.
[[nodiscard]] inline double least_upright(double slope_degrees) {
  return std::cos(slope_degrees * (std::numbers::pi / 180.0)) - cosine_rounding;
}

}  // namespace roam
