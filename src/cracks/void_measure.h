#pragma once
/// \file
/// How wide a void is: flooded on a lattice, for a climb alone stops on the ridge of an arm and a flood alone is
/// coarse.

#include <vector>

#include "cracks/open_drops.h"

namespace roam::cracks {

/// A void that was measured: the largest disc of all its arms.
struct MeasuredVoid {
  Disc disc;
  double foot = 0.0;
  std::vector<Vec3> rim;
};

/// The voids of rim places that lie in no drop that was climbed to, and what of them turned out to be one after all.
/// Places that belong to drops are left out. `is_reached` as find_cracks. `goes_on` is asked from
/// several threads, one at a time, with the fraction done; when it says so, or `ended` is set before, what is not
/// measured yet is as wide as its best climb, to some millimetres.
[[nodiscard]] std::vector<MeasuredVoid> measure_voids(const CrackOptions& options, const VoidProbe& probe,
                                                      const OpenDrops& drops, const std::vector<RimPlace>& places,
                                                      const std::function<bool(const Vec3& foot)>& is_reached,
                                                      const std::function<bool(double)>& goes_on,
                                                      std::atomic<bool>& ended);

}  // namespace roam::cracks
