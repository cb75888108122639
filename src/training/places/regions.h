#pragma once
/// \file
/// Where another size is to be used: the necks that the body does not pass, and the rooms behind that it does not fit.

#include <span>
#include <vector>

#include "roam/passage.h"
#include "roam/size_region.h"
#include "training/places/places.h"

namespace roam::training {

/// Of the radius that passes an opening the body gets so much: what is left over, 1 cm on each side of a door of 0.7 m,
/// is for turning into it. Walkers came through 50 of 50 made galleries with it.
inline constexpr double region_share = 0.97;

/// Regions for a body of `radius`, `rooms` being those found for it, and `openings` the refined passage through each
/// of rooms.necks, in their order. One for each neck that is passed by a smaller body only: its box, grown by `radius`
/// to all sides and to the body's head and feet, with region_share of the passage's radius; and one for each room that
/// a body of `radius` does not fit into, with the largest radius that gets there. Passages of less than `least` do not
/// count. Where none is found there is no region. Feet are none of these: SizeRegion::support_radius is 0.
[[nodiscard]] std::vector<SizeRegion> make_regions(const ways::Measure& measure, const ways::WidestTree& tree,
                                                   const Rooms& rooms, double least, double radius,
                                                   std::span<const Passage> openings);

}  // namespace roam::training
