#pragma once
/// \file
/// Where the search for places begins.

#include <cstdint>
#include <vector>

#include "roam/survey.h"
#include "ways/lattice/lattice.h"

namespace roam::training {

/// Points that leave no room of a scene out, in an order drawn by `seed`, which does not depend on that of the
/// triangles. On foot they lie on the floors: first the middles of some triangles (where the scene is detailed, which
/// is where the small rooms of a large scene are), then one for each cell of a lattice over which a floor lies (by
/// area). Flying: the same, lifted by half a metre, and one in each cell of the scene's box.
[[nodiscard]] std::vector<Vec3> sample_places(const Survey& survey, Mode mode, std::uint64_t seed);

}  // namespace roam::training
