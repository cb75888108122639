#pragma once
/// \file
/// The scene for engines that compute in floats.

#include <cstdint>
#include <vector>

#include "scene.h"

namespace roam::bench {

/// All triangles of a scene in one list.
struct FloatMesh {
  std::vector<float> vertices;         ///< x, y, z of each, in metres, rounded to nearest
  std::vector<std::uint32_t> indices;  ///< three of each triangle

  FloatMesh() = default;
  explicit FloatMesh(const Scene& scene);
};

}  // namespace roam::bench
