#pragma once
/// \file
/// The maximum norm, which error bounds use.

#include <algorithm>
#include <cmath>

#include "roam/math.h"

namespace roam {

/// The largest absolute component. Unspecified for a vector with a NaN.
inline double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace roam
