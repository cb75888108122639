#pragma once
/// \file
/// Triangle meshes: the input of World::build(). Lengths are metres.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "roam/math.h"

namespace roam {

inline constexpr double coordinate_limit = 1e9;  ///< largest absolute coordinate of a vertex
using Triangle = std::array<Vec3, 3>;            ///< three corners; equal corners (a line, a point) are valid

/// The triangles of one object of the scene: a node, a mesh or a layer of a file.
struct Mesh {
  std::string name = {};                                     ///< of the object, for display; may be empty
  std::vector<Vec3> vertices = {};                           ///< in the scene's frame
  std::vector<std::array<std::uint32_t, 3>> triangles = {};  ///< indices into vertices; either winding
  std::uint64_t user_data = 0;                               ///< the program's own; Space::object() returns it
  [[nodiscard]] Triangle triangle(std::size_t i) const {
    const auto& t = triangles[i];
    return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
  }
};

}  // namespace roam
