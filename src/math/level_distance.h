#pragma once
/// \file
/// The distance of two points seen from above.

#include <cmath>

#include "roam/math.h"

namespace roam {

[[nodiscard]] inline double level_distance(const Vec3& a, const Vec3& b) { return std::hypot(a.x - b.x, a.y - b.y); }

}  // namespace roam
