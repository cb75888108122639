#pragma once
/// \file
/// The search behind free_disc(), for a foot that moves.

#include "roam/support.h"

namespace roam::walking {

/// Where a disc was found: the next one is likely to be there too.
struct DiscFound {
  bool found = false;
  double x = 0.0, y = 0.0;  ///< of its centre, metres
};

/// See free_disc(). `last` is where a disc was found before, if anywhere, and becomes where one is now: a body that
/// hardly moves is answered by two queries.
[[nodiscard]] DiscRoom find_disc(const Space& space, const FloorPlane& plane, const SupportDisc& disc, const Vec3& axis,
                                 DiscFound& last);

}  // namespace roam::walking
