#pragma once
/// \file
/// Boxes of points.

#include "roam/math.h"

namespace roam {

/// The box of some points, such as the corners of a triangle.
template <class Points>
[[nodiscard]] Box box_around(const Points& points) {
  Box box;
  for (const Vec3& point : points) box.include(point);
  return box;
}

/// Whether two boxes have a point in common.
[[nodiscard]] inline bool meet(const Box& a, const Box& b) {
  for (int k = 0; k < 3; ++k) {
    if (a.lower[k] > b.upper[k] || b.lower[k] > a.upper[k]) return false;
  }
  return true;
}

}  // namespace roam
