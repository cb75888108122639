#pragma once
/// \file
/// The widest way through each neck, so that it can be refined.

#include <vector>

#include "training/places/places.h"
#include "ways/lattice/lattice.h"

namespace roam::training {

/// For each of rooms.necks, in their order: the places of the widest way through it, from the first room that it
/// touches to another. Continues into both rooms as long as the way widens. Empty if the lattice has no such way.
[[nodiscard]] std::vector<std::vector<Vec3>> neck_ways(const ways::WidestTree& tree, const Rooms& rooms);

}  // namespace roam::training
