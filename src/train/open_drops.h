#pragma once
/// \file
/// Voids that are wider than any foot: pits, shafts, cliffs, the end of a floor.

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "train/voids.h"

namespace roam::training {

/// m, seen from above.
[[nodiscard]] inline double level_distance(const Vec3& a, const Vec3& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// The number of a square of a lattice in the plan; squares 2^32 apart share one.
[[nodiscard]] inline std::uint64_t square_number(std::int64_t x, std::int64_t y) {
  return std::uint64_t(std::uint32_t(x)) << 32 | std::uint32_t(y);
}

/// The number of a square of the plan, `side` wide; squares 2^32 apart share one.
[[nodiscard]] std::uint64_t square_at(double x, double y, double side);

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

/// Whether a disc that is free in a void is a part of an open drop that it lies beside, as between the end of a floor
/// and a post that stands before it: who falls in there comes to the drop without squeezing through anything, before an
/// open disc is clear of this one, and no floor beyond is reached, so that no foot is to carry there. `is_reached` as
/// in find_cracks.
[[nodiscard]] bool opens_into_drop(const CrackOptions& options, const VoidProbe& probe,
                                   const std::function<bool(const Vec3& foot)>& is_reached, const Disc& disc);

/// The numbers of places whose discs lie within `reach` of each other, level by level, at about one level: each group
/// ascending, in the order of their first ones.
[[nodiscard]] std::vector<std::vector<std::size_t>> together(const std::vector<RimPlace>& places, double reach,
                                                             double step);

}  // namespace roam::training
