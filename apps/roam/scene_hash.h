#pragma once
/// \file
/// A hash by which two scenes are known to be the same.

#include <span>
#include <string>

#include "roam/mesh.h"

namespace roam::app {

/// XXH3-128 over the corners of all triangles in their order, each three little-endian doubles, in 32 hexadecimal
/// digits. The same triangles in another file format have the same hash; names do not count.
[[nodiscard]] std::string scene_hash(std::span<const Mesh> meshes);

}  // namespace roam::app
