#pragma once
/// \file
/// One walk or flight along a planned way by a body of one size, and how it ended.

#include <cstddef>

#include "roam/math.h"
#include "roam/route.h"

namespace roam {

struct Trial {
  double radius = 0.0;
  double support_radius = 0.0;  ///< 0: none of its own
  Outcome outcome = Outcome::reached;
  Vec3 at{0.0};          ///< of the centre when it ended
  std::size_t path = 0;  ///< of Training::paths
};

}  // namespace roam
