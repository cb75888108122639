#pragma once
/// \file
/// The search behind carrying(), for a support disc that moves.

#include "motion/carrying.h"

namespace roam::walking {

/// Position where a disc was found; the next one is likely to be there too.
struct DiscFound {
  bool found = false;
  double x = 0.0, y = 0.0;  ///< centre of the disc, metres
};

/// See carrying(). `last` is the position of an earlier disc, if any, and is set to that of the disc found now. For a
/// body that hardly moves, two queries suffice.
[[nodiscard]] Carrying find_disc(const Space& space, const FloorPlane& plane, const SupportDisc& disc, const Vec3& axis,
                                 DiscFound& last);

}  // namespace roam::walking
