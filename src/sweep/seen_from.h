#pragma once
/// \file
/// Triangles of a scene in the local frame of the certified functions.

#include <algorithm>

#include "math/largest.h"
#include "roam/mesh.h"
#include "sweep/certified.h"
#include "sweep/error_bound.h"

namespace roam::certified {

/// The triangle relative to `origin`. Subtraction is the only rounding: at most unit_roundoff of each difference.
inline LocalTriangle seen_from(const Vec3& origin, const Triangle& t) {
  const Vec3 a = t[0] - origin, b = t[1] - origin, c = t[2] - origin;
  return {{a, b, c}, unit_roundoff * std::max({largest(a), largest(b), largest(c)})};
}

}  // namespace roam::certified
