#pragma once
/// \file
/// Voids that are wider than any foot: pits, shafts, cliffs, the end of a floor; and which places beside them are a
/// part of one.

#include <atomic>
#include <unordered_map>
#include <vector>

#include "cracks/plan_squares.h"
#include "cracks/voids.h"

namespace roam::cracks {

/// Whether the open disc about `centre` takes in a place of a void whose distance of floor is `floor`: in sight of the
/// centre, and within support_max of it, or where the way to it leads so steadily away from floor as in a pit's corner
/// that is no sharper than a right angle.
[[nodiscard]] bool takes_in(const CrackOptions& options, const VoidProbe& probe, const Vec3& centre, const Vec3& place,
                            double floor);

/// Where the discs of open drops lie.
class OpenDrops {
 public:
  OpenDrops(const CrackOptions& options, const VoidProbe& probe, const std::vector<RimPlace>& open);
  /// One of them takes in the place, at about the same level. `floor`: as takes_in.
  [[nodiscard]] bool cover(const Vec3& place, double floor) const;
  /// Likewise; asks for the distance of floor itself.
  [[nodiscard]] bool cover(const Vec3& place) const;
  /// A centre at about the same level lies within `reach` (m, at most 3 support_max), seen or not.
  [[nodiscard]] bool any_near(const Vec3& place, double reach) const;

 private:
  template <typename Asked>
  bool any(const Vec3& place, int squares, const Asked& asked) const;

  CrackOptions options_;
  const VoidProbe& probe_;
  double side_;
  std::unordered_map<std::uint64_t, std::vector<Vec3>> centres_;
};

/// Whether a place of a void is a part of an open drop that it lies beside, as between the end of a floor and a post
/// that stands before it: the largest body that stands there comes to the drop through nothing narrower than itself (to
/// some millimetres), before an open disc is clear of it, and no floor beyond is reached, so that no foot is to carry
/// there. `is_reached` as in find_cracks. Once `ended` is set, none is.
[[nodiscard]] bool opens_into_drop(const CrackOptions& options, const VoidProbe& probe,
                                   const std::function<bool(const Vec3& foot)>& is_reached, const Vec3& place,
                                   const std::atomic<bool>& ended);

}  // namespace roam::cracks
