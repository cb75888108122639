#pragma once
/// \file
/// Voids wider than any disc: pits, shafts, cliffs, the end of a floor. Also finds the places beside them that belong
/// to them.

#include <atomic>
#include <unordered_map>
#include <vector>

#include "cracks/plan_squares.h"
#include "cracks/voids.h"

namespace roam::cracks {

/// Whether the open disc around `centre` covers a place of a void. `floor`: the place's distance from floor. The place
/// must be in sight of the centre. It must be within support_max, or the distance from floor must grow on the way to
/// the centre as steadily as in a pit's corner no sharper than a right angle.
[[nodiscard]] bool takes_in(const CrackOptions& options, const VoidProbe& probe, const Vec3& centre, const Vec3& place,
                            double floor);

/// The discs of open drops, by position.
class OpenDrops {
 public:
  OpenDrops(const CrackOptions& options, const VoidProbe& probe, const std::vector<RimPlace>& open);
  /// Whether a disc at about the same level covers the place. `floor`: as takes_in.
  [[nodiscard]] bool cover(const Vec3& place, double floor) const;
  /// The same; queries the distance from floor itself.
  [[nodiscard]] bool cover(const Vec3& place) const;
  /// Whether a centre at about the same level lies within `reach` (m, at most 3 support_max), in sight or not.
  [[nodiscard]] bool any_near(const Vec3& place, double reach) const;

 private:
  template <typename Accept>
  bool any(const Vec3& place, int squares, const Accept& accept) const;

  CrackOptions options_;
  const VoidProbe& probe_;
  double side_;
  std::unordered_map<std::uint64_t, std::vector<Vec3>> centres_;
};

/// Whether a place of a void belongs to an open drop beside it, as between the end of a floor and a post in front of
/// it. The largest body that stands there must reach the drop through nothing narrower than itself (to some
/// millimetres), going no farther than its radius + support_max. False if reached floor lies on two sides of the place,
/// because then a disc must carry the body across. `is_reached` as in find_cracks. False once `ended` is set.
[[nodiscard]] bool opens_into_drop(const CrackOptions& options, const VoidProbe& probe,
                                   const std::function<bool(const Vec3& foot)>& is_reached, const Vec3& place,
                                   const std::atomic<bool>& ended);

}  // namespace roam::cracks
