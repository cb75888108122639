#pragma once
/// \file
/// The occupied cells of a tile's box.

#include <array>
#include <cstdint>

#include "roam/mesh.h"
#include "store/page.h"
#include "store/tile_view.h"

namespace roam::store {

/// Numbers of cells along each axis, both ends included.
struct CellRange {
  int first[3], last[3];
};

/// How many of some cells a mask has.
enum class Filled : std::uint8_t { none, some, all };
[[nodiscard]] Filled filled(const TileEntry& entry, const CellRange& range);

/// The cells of a tile's box, and which of them a triangle may touch.
class CellGrid {
 public:
  /// `margin`, in metres: triangles are grown by it.
  CellGrid(const Box& box, double margin);

  /// Calls f(x, y, z) for each cell that a triangle in the box touches, and perhaps for cells that it misses by
  /// rounding. Ends where f returns false; returns whether it never did.
  template <class F>
  bool visit(const Triangle& triangle, F&& f) const;

  /// The cells that a box touches, grown by the margin.
  [[nodiscard]] CellRange range(const Vec3& lower, const Vec3& upper) const;

 private:
  Vec3 lower_, per_metre_, cell_, half_;
  double margin_;
};

/// Builds TileEntry::mask: marks every cell that a triangle, grown by `margin`, may touch, whatever the rounding.
class Mask {
 public:
  /// `margin`: metres.
  Mask(const Box& box, double margin);
  void add(const Triangle& triangle);

  std::array<std::uint64_t, mask_cells * mask_cells * mask_cells / 64> words{};

 private:
  CellGrid grid_;
};

/// Checks that the triangles of a decoded tile lie in its entry's box, in cells of its mask: queries of the tile, and
/// of its cells before it is loaded, then find each of them. Returns null, or what is wrong. Never allocates.
[[nodiscard]] const char* check_place(const TileEntry& entry, const TileView& tile);

}  // namespace roam::store
