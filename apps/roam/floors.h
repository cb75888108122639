#pragma once
/// \file
/// Where a scene may have floors.

#include <cstddef>
#include <span>
#include <vector>

#include "roam/mesh.h"

namespace roam::app {

/// The middles of up to `count` triangles that lie flat enough to stand on and face up, spread evenly over all that do,
/// in the order of the file. A gallery in a wide landscape is a speck on the map, but most of the triangles: where the
/// triangles are is where people want to be. And its ceiling, which faces down, is no floor for those who would stand
/// in the rock above it. Deterministic.
[[nodiscard]] std::vector<Vec3> floor_samples(std::span<const Mesh> meshes, std::size_t count = 512);

}  // namespace roam::app
