#pragma once
/// \file
/// A tile that is not in memory: solid in the occupied cells of its box.

#include "index/traverse.h"
#include "store/page.h"
#include "world/box_tree.h"
#include "world/query.h"

namespace roam::paging {

/// Some cells of a tile, united into a box.
struct Cells {
  Box box;
  TriangleId first = 0;  ///< the number of the first of them
};

/// The first of a tile's occupied cells that the body meets, or comes nearer to than Pager::margin.
struct MetCells {
  double time = 1.0;  ///< of the piece
  Cells cells;
};

/// Looks no farther than `until`, which is the time of the answer when nothing is met before.
[[nodiscard]] MetCells sweep_cells(const store::TileEntry& tile, const index::Piece& piece, double until);

/// Offers the collector all cells within its reach of the way. Sides are numbered from `base`.
void near_cells(const store::TileEntry& tile, const index::Piece& piece, TriangleId base, Collector& collector);

/// The body's way and all that is within its radius, Pager::margin and `reach` of it.
[[nodiscard]] Sweep way_around(const index::Piece& piece, double reach);

/// What the body meets, or is near, of one box; numbers of sides count from `base`.
[[nodiscard]] Contact near_box(const Box& box, const index::Piece& piece, TriangleId base);

}  // namespace roam::paging
