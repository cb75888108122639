#pragma once
/// \file
/// Partition of a set of triangles into tiles.

#include <cstdint>
#include <functional>
#include <vector>

#include "index/soup.h"

namespace roam::index {

/// Greatest number of triangles of a tile.
inline constexpr std::uint32_t most_tile_triangles = 16384;

/// Metres. Triangles whose box has a larger side go to tiles of their own size class. Each class is sixteen times wider
/// than the one before, so that the grids of the others stay fine.
inline constexpr double ordinary_triangle = 16.0;
inline constexpr int class_factor_bits = 4;

/// Metres. Greatest width of a tile, except for a single cell of the curve or a wider triangle. Then the 32 bits of a
/// coordinate keep the precision that World promises: 3.3e-6 m at 2^14 m in a lossless world, 0.42 mm at 2^21 m in
/// others.
inline constexpr double widest_lossless = 16384.0;
inline constexpr double widest_box = 2097152.0;

/// Runs with fewer triangles than this are not worth tiles of 64 m. Their tiles may be sixteen times wider and keep
/// their low bits. Measured on a gallery under a coarse terrain, 0.5 M triangles: 75 tiles instead of 533, 2.4 fewer
/// node visits.
inline constexpr std::uint32_t sparse_triangles = 2048;

struct Partition {
  struct Run {
    std::uint32_t begin, end;  ///< of order
  };
  std::vector<std::uint32_t> order;  ///< triangle numbers
  std::vector<Run> tiles;            ///< in order
};

/// Sorts the triangles by size class and then along the Morton curve of their box centres, and cuts the curve at cell
/// borders until every run is small enough. `tick` is called with the fraction done; it may throw.
[[nodiscard]] Partition partition(const Soup& soup, bool lossless, const std::function<void(double)>& tick);

}  // namespace roam::index
