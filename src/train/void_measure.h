#pragma once
/// \file
/// How wide a void is: flooded on a lattice, for a climb alone stops on the ridge of an arm and a flood alone is
/// coarse.

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "train/voids.h"

namespace roam::training {

/// Where the discs of open drops lie.
class OpenDrops {
 public:
  OpenDrops(const CrackOptions& options, const VoidProbe& probe, const std::vector<RimPlace>& open);
  /// Within support_max of the centre of an open disc at about the same level, and in sight of it.
  [[nodiscard]] bool cover(const Vec3& place) const;

 private:
  const VoidProbe& probe_;
  double reach_, step_;
  std::unordered_map<std::uint64_t, std::vector<Vec3>> centres_;
};

/// A void that was measured: the largest disc of all its arms.
struct MeasuredVoid {
  Disc disc;
  double foot = 0.0;
  std::vector<Vec3> rim;
};

/// The voids of rim places whose climbs ended below probe.open(), and those that turned out to be as large after all.
/// Places that `drops` cover belong to them and are left out. `goes_on` is asked from several threads, one at a time,
/// with the fraction done; when it says so, or `ended` is set before, what is not measured yet is as wide as its best
/// climb, to some millimetres.
[[nodiscard]] std::vector<MeasuredVoid> measure_voids(const CrackOptions& options, const VoidProbe& probe,
                                                      const OpenDrops& drops, const std::vector<RimPlace>& places,
                                                      const std::function<bool(double)>& goes_on,
                                                      std::atomic<bool>& ended);

/// The numbers of places whose discs lie within `reach` of each other, level by level, at about one level: each group
/// ascending, in the order of their first ones.
[[nodiscard]] std::vector<std::vector<std::size_t>> together(const std::vector<RimPlace>& places, double reach,
                                                             double step);

/// The number of a square of the plan, `side` wide; squares 2^32 apart share one.
[[nodiscard]] std::uint64_t square_at(double x, double y, double side);

}  // namespace roam::training
