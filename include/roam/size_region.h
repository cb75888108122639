#pragma once
/// \file
/// A part of a scene where a body has another size than elsewhere.

#include <string>

#include "roam/math.h"

namespace roam {

/// In `bounds` a body has this size. Where regions overlap, the smallest body and the largest foot count.
struct SizeRegion {
  Box bounds = {};              ///< metres, not empty
  double radius = 0.0;          ///< of the body, metres, > 0; a capsule keeps its height
  double support_radius = 0.0;  ///< of its foot, metres: see WalkerSettings::support_radius; 0: none of its own
  std::string why = {};         ///< for people: "door 0.71 m wide"
};

}  // namespace roam
