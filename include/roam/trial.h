#pragma once
/// \file
/// Trial: one walk or flight of a body along a planned way, and its outcome.

#include <cstddef>

#include "roam/math.h"
#include "roam/route.h"

namespace roam {

struct Trial {
  double radius = 0.0;
  double support_radius = 0.0;  ///< 0: none
  Outcome outcome = Outcome::reached;
  Vec3 at{0.0};          ///< its centre at the end, metres
  std::size_t path = 0;  ///< index into Training::paths
};

}  // namespace roam
