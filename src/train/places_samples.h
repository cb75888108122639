#pragma once
/// \file
/// Where the search for places begins.

#include <cstdint>
#include <vector>

#include "roam/survey.h"
#include "train/lattice.h"

namespace roam::training {

/// Points that leave no room of a scene out, in an order drawn by `seed`, which does not depend on that of the
/// triangles. On foot they lie on the floors: one for each cell of a lattice over which a floor lies (by area), and the
/// middles of some triangles (where the scene is detailed, which is where small rooms of a large scene are). Flying:
/// the same, lifted by half a metre, and one in each cell of the scene's box.
[[nodiscard]] std::vector<Vec3> sample_places(const Survey& survey, Mode mode, std::uint64_t seed);

}  // namespace roam::training
