#pragma once
/// \file
/// The steepest part of a way.

#include <span>

#include "roam/math.h"

namespace roam::measure {

struct Slope {
  double degrees = 0.0;  ///< [0, 90], up or down
  Vec3 place{0.0};       ///< the middle of that part
  double rise = 0.0;     ///< m: sum of all parts that lead up
  double fall = 0.0;     ///< m: sum of all parts that lead down, >= 0
};

/// The steepest slope of a polyline, averaged over parts of at least `over` (m, > 0) seen from above, or over all of it
/// if it is shorter. Steps of less than that count as the stairs or ramp that they are part of.
[[nodiscard]] Slope steepest(std::span<const Vec3> way, double over = 1.0);

}  // namespace roam::measure
