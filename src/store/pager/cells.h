#pragma once
/// \file
/// Queries of a tile that is not in memory. The occupied cells of its box are solid.

#include "index/traverse.h"
#include "store/page.h"
#include "world/box_tree.h"
#include "world/query.h"

namespace roam::paging {

/// Cells of a tile, united into a box.
struct Cells {
  Box box;
  TriangleId first = 0;  ///< the number of the first cell
};

/// The first occupied cells of a tile that the body meets, or comes nearer to than Pager::margin.
struct MetCells {
  double time = 1.0;  ///< of the piece, 0 to 1
  Cells cells;
};

/// Ignores contacts after `until`, which is the time of the result if nothing is met before.
[[nodiscard]] MetCells sweep_cells(const store::TileEntry& tile, const index::Piece& piece, double until);

/// Offers the collector all cells within its reach of the path. Numbers of sides start at `base`.
void near_cells(const store::TileEntry& tile, const index::Piece& piece, TriangleId base, Collector& collector);

/// A box sweep that contains the body's path and all points within its radius, Pager::margin and `reach` of it.
[[nodiscard]] Sweep way_around(const index::Piece& piece, double reach);

/// The contact, or nearest point, of the body and one box. Numbers of sides start at `base`.
[[nodiscard]] Contact near_box(const Box& box, const index::Piece& piece, TriangleId base);

}  // namespace roam::paging
