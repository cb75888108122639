#pragma once
/// \file
/// A decoded tile: its entry's grid, and the leaves in memory.

#include <cstddef>
#include <span>

#include "index/block.h"
#include "roam/mesh.h"
#include "store/page.h"

namespace roam::store {

struct TileView {
  index::Tile tile;  ///< its nodes and leaves are where they were decoded
  std::span<const index::Leaf> leaves;
  std::span<const index::FineLeaf> fine;  ///< empty unless the tile is fine
};

/// The grid of a tile that is not in memory.
[[nodiscard]] index::Tile absent_tile(const TileEntry& entry);

/// What TileDecoder::decode has written for the entry.
[[nodiscard]] TileView view_tile(const TileEntry& entry, std::span<const std::byte> decoded);

/// The corners of triangle `triangle` of a leaf in the scene's frame, with each stored coordinate correctly rounded.
/// `fine`: the leaf's low bits, or null.
[[nodiscard]] Triangle stored_triangle(const index::Tile& tile, const index::Leaf& leaf, const index::FineLeaf* fine,
                                       int triangle);

}  // namespace roam::store
