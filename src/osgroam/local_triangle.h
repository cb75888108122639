#pragma once
/// \file
/// Triangles of the scene as the certified functions of the core take them.

#include <algorithm>

#include "math/largest.h"
#include "roam/mesh.h"
#include "sweep/certified.h"
#include "sweep/error_bound.h"

namespace osgRoam {

/// Subtraction is the only rounding: at most unit_roundoff of each difference.
inline roam::certified::LocalTriangle seen_from(const roam::Vec3& origin, const roam::Triangle& t) {
  const roam::Vec3 a = t[0] - origin, b = t[1] - origin, c = t[2] - origin;
  return {{a, b, c}, roam::certified::unit_roundoff * std::max({roam::largest(a), roam::largest(b), roam::largest(c)})};
}

}  // namespace osgRoam
