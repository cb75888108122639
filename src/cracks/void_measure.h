#pragma once
/// \file
/// The width of a void. It is flooded on a lattice first, then climbed: a climb alone would stop on the ridge of one
/// arm, and a flood alone is coarse.

#include <vector>

#include "cracks/open_drops.h"

namespace roam::cracks {

/// A measured void: the largest disc of all its arms.
struct MeasuredVoid {
  Disc disc;
  double support_radius = 0.0;
  std::vector<Vec3> rim;
};

/// The voids of rim places outside the known drops, including parts that prove to be drops themselves. Places that
/// belong to drops are left out. `is_reached` as in find_cracks. Calls `goes_on` with the fraction done, from several
/// threads, one at a time. After it returns false, or if `ended` is set, each void not measured yet gets the width of
/// its best climb, to some millimetres.
[[nodiscard]] std::vector<MeasuredVoid> measure_voids(const CrackOptions& options, const VoidProbe& probe,
                                                      const OpenDrops& drops, const std::vector<RimPlace>& places,
                                                      const std::function<bool(const Vec3& foot)>& is_reached,
                                                      const std::function<bool(double)>& goes_on,
                                                      std::atomic<bool>& ended);

}  // namespace roam::cracks
