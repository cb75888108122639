#pragma once
/// \file
/// Where along a way something lies.

#include <limits>
#include <span>

#include "roam/math.h"
#include "roam/walker.h"

namespace roam::ways {

/// The place of a way that is nearest to a point.
struct OnWay {
  double along = 0.0;                                      ///< m of the way up to there
  double apart = std::numeric_limits<double>::infinity();  ///< m from the point; infinite: the way has no places
  Vec3 place{0.0};
  Vec3 heading{0.0};  ///< unit, as the way leads there; 0: it leads nowhere
};

/// Flying, the nearest in space. On foot the ways are those of feet, and points are of what stands on the floor or lies
/// in it: the nearest seen from above, on the same storey.
[[nodiscard]] OnWay nearest_on(std::span<const Vec3> way, const Vec3& point, Mode mode);

}  // namespace roam::ways
