#pragma once
/// \file
/// Tests for finite numbers.

#include <cmath>

#include "roam/math.h"
#include "roam/mesh.h"

namespace roam {

[[nodiscard]] inline bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Whether all coordinates are within coordinate_limit. False for a NaN.
[[nodiscard]] inline bool is_within_limit(const Vec3& v) {
  return std::abs(v.x) <= coordinate_limit && std::abs(v.y) <= coordinate_limit && std::abs(v.z) <= coordinate_limit;
}

}  // namespace roam
