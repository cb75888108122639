#pragma once
/// \file
/// Regions with another size: necks that the body does not pass, and rooms behind them that it does not fit into.

#include <span>
#include <vector>

#include "roam/passage.h"
#include "roam/walker_settings.h"
#include "training/places/places.h"

namespace roam::training {

/// The share of an opening's radius that the body gets. The rest, 1 cm on each side of a door of 0.7 m, is room to turn
/// into it. With this value walkers passed 50 of 50 generated galleries.
inline constexpr double region_share = 0.97;

/// Regions for a body of `radius`. `rooms` must be those found for this radius; `openings` has the refined passage
/// through each of rooms.necks, in their order. Each neck that only a smaller body passes gets a region: its box, grown
/// by `radius` to all sides and to the body's head and feet, with region_share of the passage's radius. Each room that
/// a body of `radius` does not fit into gets one with the largest radius that reaches it. Passages that were not found
/// or are narrower than `least` give no region. SizeRegion::support_radius is 0 in all of them.
[[nodiscard]] std::vector<SizeRegion> make_regions(const ways::Measure& measure, const ways::WidestTree& tree,
                                                   const Rooms& rooms, double least, double radius,
                                                   std::span<const Passage> openings);

}  // namespace roam::training
