#pragma once
/// \file
/// Tests for finite numbers.

#include <cmath>

#include "roam/math.h"

namespace roam {

[[nodiscard]] inline bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace roam
