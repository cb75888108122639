#pragma once
/// \file
/// Which size a body has where, and becoming another size on the spot.

#include <span>

#include "motion/gait.h"
#include "motion/move.h"
#include "roam/size_region.h"

namespace roam::walking {

/// The settings of a body that has another size: a capsule keeps its height, a sphere stays one.
[[nodiscard]] WalkerSettings sized(const WalkerSettings& given, const Size& size);

/// The sizes of a walker, as it keeps them.
struct Sizes {
  const WalkerSettings& given;  ///< when it was made
  const Size& outside;          ///< of all regions
  std::span<const SizeRegion> regions;
  std::span<char> inside;   ///< of each region: whether the body counts as in it
  WalkerSettings& present;  ///< those that the move goes by

  /// Whether the body can have no other size now than it has.
  [[nodiscard]] bool settled() const {
    return regions.empty() && present.radius == outside.radius && present.support_radius == outside.support_radius;
  }
};

/// The size that is wanted of a body with this centre and lowest point. Comes to be in a region, and leaves it, here.
[[nodiscard]] Size wanted(const Sizes& sizes, const Vec3& centre, const Vec3& feet);

/// Gives the body the size that is wanted where it is: smaller at once, larger when it fits. Its lowest point stays,
/// but on a slope it may rise as far as the larger body needs.
void adapt(Move& move, const Gait& gait, const Sizes& sizes);

/// Whether a motion comes so near to a region that the body may become another size on it.
[[nodiscard]] bool near_region(const Sizes& sizes, const Move& move, const Vec3& motion);

}  // namespace roam::walking
