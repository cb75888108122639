#pragma once
/// \file
/// The points where the search for places begins.

#include <cstdint>
#include <vector>

#include "roam/survey.h"
#include "ways/lattice/lattice.h"

namespace roam::training {

/// Sample points that miss no room of a scene, in an order drawn by `seed`, independent of the triangles' order. On
/// foot they lie on the floors. First come the middles of some triangles, because small rooms of a large scene are its
/// detailed parts. Then comes one for each lattice cell under a floor. When flying: the same points lifted by half a
/// metre, and one in each cell of the scene's box.
[[nodiscard]] std::vector<Vec3> sample_places(const Survey& survey, Mode mode, std::uint64_t seed);

}  // namespace roam::training
