#pragma once
/// \file
/// A region of a scene with its own size of the body, for Walker::set_regions(). Lengths are metres.

#include <string>

#include "roam/math.h"

namespace roam {

/// A box and the size of the body in it. If regions overlap, the smallest body and the largest support disc apply.
struct SizeRegion {
  Box bounds = {};              ///< finite, not empty
  double radius = 0.0;          ///< of the body, > 0; a capsule keeps its height
  double support_radius = 0.0;  ///< of the support disc, see WalkerSettings::support_radius; 0: no disc in here
  std::string why = {};         ///< for display: "door 0.71 m wide"
};

}  // namespace roam
