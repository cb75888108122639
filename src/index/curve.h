#pragma once
/// \file
/// Positions on a Morton curve: the order in which triangles are cut into tiles.
///
/// A key holds the size class of a triangle in its top 4 bits. Below them are the interleaved bits of the cell that
/// contains the centre of its box.

#include <cmath>
#include <cstdint>

#include "index/partition.h"

namespace roam::index {

/// 0 for ordinary triangles; each further class is sixteen times wider. `extent`: the widest side of the box, m.
inline std::uint32_t size_class(double extent) {
  std::uint32_t c = 0;
  for (double limit = ordinary_triangle; extent > limit && c < 15; limit = std::ldexp(limit, class_factor_bits)) ++c;
  return c;
}

/// Inserts two zero bits after each of the low 21 bits.
inline std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffffULL;
  x = (x | x << 16) & 0x001f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  return (x | x << 2) & 0x1249249249249249ULL;
}

/// The inverse of spread.
inline std::uint64_t gather(std::uint64_t x) {
  x = (x | x >> 2) & 0x10c30c30c30c30c3ULL;
  x = (x | x >> 4) & 0x100f00f00f00f00fULL;
  x = (x | x >> 8) & 0x001f0000ff0000ffULL;
  x = (x | x >> 16) & 0x001f00000000ffffULL;
  return (x | x >> 32) & 0x00000000001fffffULL;
}

/// The curve over one scene in memory: 2^20 cells along the scene's widest side.
struct SceneCurve {
  using Key = std::uint64_t;
  static constexpr int axis_bits = 20;
  static constexpr int class_shift = 3 * axis_bits;
  static constexpr Key axis_mask = 0x1249249249249249ULL;                           ///< the bits of the first axis
  static constexpr std::uint32_t most_tile_triangles = index::most_tile_triangles;  ///< no tile holds more
  static Key spread(std::uint64_t x) { return index::spread(x); }
  static std::uint64_t gather(Key place) { return index::gather(place); }
};

}  // namespace roam::index
