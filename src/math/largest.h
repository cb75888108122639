#pragma once
/// \file
/// The size of a vector as error bounds count it.

#include <algorithm>
#include <cmath>

#include "roam/math.h"

namespace roam {

/// The largest absolute component. Of a vector with a NaN it means nothing.
inline double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace roam
