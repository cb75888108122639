#pragma once
/// \file
/// Triangles one by one, as stores hand them out, into a mesh.

#include <cstdint>
#include <span>

#include "roam/mesh.h"

namespace roam::app {

/// Adds triangles that share no vertex.
inline void append(Mesh& mesh, std::span<const Triangle> triangles) {
  for (const Triangle& triangle : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), triangle.begin(), triangle.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
}

}  // namespace roam::app
