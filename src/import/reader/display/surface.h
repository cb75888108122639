#pragma once
/// \file
/// Triangles with vertex looks, and their division into chunks, which are the units of culling.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "import/reader/display/look.h"
#include "roam/math.h"

namespace roam::reader {

using Corners = std::array<std::uint32_t, 3>;

struct Surface {
  std::vector<Vec3> vertices;  ///< in the frame of the scene
  std::vector<VertexLook> looks;
  std::vector<Corners> triangles;
  /// Triangles from `first` on, up to those of the next run, are of one object.
  struct Run {
    std::uint32_t object = 0;  ///< number in PartPool
    std::uint32_t first = 0;
  };
  std::vector<Run> runs;  ///< ascending; the first one begins with the first triangle

  [[nodiscard]] std::size_t bytes() const {
    return vertices.size() * (sizeof(Vec3) + sizeof(VertexLook)) + triangles.size() * sizeof(Corners) +
           runs.size() * sizeof(Run);
  }
};

/// Most triangles of a chunk. Their corners fit into 16-bit indices, and a million triangles are a few hundred chunks
/// at most.
inline constexpr std::size_t chunk_triangles = 16384;
static_assert(3 * chunk_triangles <= 65536);

/// The triangles of each chunk, ascending, as spans of `order`, which receives all triangle indices. Cuts at the median
/// of the longest side until a chunk is small enough.
[[nodiscard]] std::vector<std::span<const std::uint32_t>> cut_into_chunks(const Surface& surface,
                                                                          std::vector<std::uint32_t>& order);

}  // namespace roam::reader
