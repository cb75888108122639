#pragma once
/// \file
/// The position of a point along a way.

#include <limits>
#include <span>

#include "roam/math.h"
#include "roam/walker.h"

namespace roam::ways {

/// The place of a way that is nearest to a point.
struct OnWay {
  double along = 0.0;                                      ///< m along the way
  double apart = std::numeric_limits<double>::infinity();  ///< m from the point; infinite: the way has no places
  Vec3 place{0.0};
  Vec3 heading{0.0};  ///< unit, the way's direction there; 0 if it has none
};

/// When flying, the nearest place in space. On foot the way is that of the feet and the point lies on or in the floor:
/// the nearest place seen from above, on the same storey.
[[nodiscard]] OnWay nearest_on(std::span<const Vec3> way, const Vec3& point, Mode mode);

}  // namespace roam::ways
