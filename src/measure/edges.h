#pragma once
/// \file
/// Open edges of a scene: whether its surfaces are closed.

#include <cstdint>
#include <optional>
#include <span>

#include "roam/mesh.h"

namespace roam::measure {

struct Edges {
  std::uint64_t all = 0;     ///< different edges
  std::uint64_t open = 0;    ///< edges of one triangle only
  std::optional<Vec3> hole;  ///< the middle of an open edge
};

/// Counts the edges of all meshes together. Corners at the same position count as one corner, whatever their mesh.
/// Edges without length do not count. Takes 168 bytes a triangle while it runs.
[[nodiscard]] Edges count_edges(std::span<const Mesh> meshes);

}  // namespace roam::measure
