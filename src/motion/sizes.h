#pragma once
/// \file
/// Sizes of a body by region, and changing the size on the spot.

#include <span>

#include "motion/gait.h"
#include "motion/move.h"
#include "roam/walker_settings.h"

namespace roam::walking {

/// The settings of a body with another size: a capsule keeps its height, a sphere stays a sphere.
[[nodiscard]] WalkerSettings sized(const WalkerSettings& given, const Size& size);

/// The sizes that a walker keeps.
struct Sizes {
  const WalkerSettings& given;  ///< as the walker was made
  const Size& outside;          ///< outside all regions
  std::span<const SizeRegion> regions;
  std::span<char> inside;   ///< for each region, whether the body counts as inside
  WalkerSettings& present;  ///< the settings in use

  /// Whether the body can have no other size at present.
  [[nodiscard]] bool settled() const {
    return regions.empty() && present.radius == outside.radius && present.support_radius == outside.support_radius;
  }
};

/// The size wanted for a body with this centre and lowest point. Updates `inside`.
[[nodiscard]] Size wanted(const Sizes& sizes, const Vec3& centre, const Vec3& feet);

/// Gives the body the size wanted at its position: a smaller one at once, a larger one when it fits. The lowest point
/// stays, except that on a slope it may rise as far as the larger body needs.
void adapt(Move& move, const Gait& gait, const Sizes& sizes);

/// Whether a motion comes so near to a region that the body may change its size.
[[nodiscard]] bool near_region(const Sizes& sizes, const Move& move, const Vec3& motion);

}  // namespace roam::walking
