#pragma once
/// \file
/// The steepest part of a way, and the slope below a body.

#include <optional>
#include <span>

#include "roam/math.h"
#include "roam/space.h"

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

/// The slope, in degrees, of the face that a body meets within 5 cm on its way down. None: it meets an edge, a corner,
/// unknown space or nothing.
[[nodiscard]] std::optional<double> slope_below(const Space& space, const Body& body, const Vec3& centre);

}  // namespace roam::measure
