#pragma once
/// \file
/// Triangles as they come from a file or from a program: the input of World::build.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "roam/math.h"

namespace roam {

/// Largest absolute coordinate of a vertex, in metres.
inline constexpr double coordinate_limit = 1e9;

/// Three corners, in metres. Points and segments (equal corners) are triangles too.
using Triangle = std::array<Vec3, 3>;

/// A run of triangles that belong to one object of the scene: a node, a mesh or a layer of the file.
struct Mesh {
  std::string name = {};                                     ///< of the object, for people; may be empty
  std::vector<Vec3> vertices = {};                           ///< metres, scene frame
  std::vector<std::array<std::uint32_t, 3>> triangles = {};  ///< indices into vertices; either winding
  std::uint64_t user_data = 0;  ///< of the program's own; Space::object() returns it

  [[nodiscard]] Triangle triangle(std::size_t i) const {
    const auto& t = triangles[i];
    return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
  }
};

}  // namespace roam
