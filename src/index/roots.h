#pragma once
/// \file
/// Where searches that stay in a box begin: below the tree over tiles and the upper levels of each tile.

#include <array>
#include <cstdint>

#include "index/block.h"

namespace roam::index {

/// A node that was made for a box, of the nodes and leaves of one tile that meet it: their boxes, cut off where that
/// ends.
struct Root {
  Node node;                                     ///< of which first_node and first_leaf mean nothing
  std::array<std::uint32_t, node_width> number;  ///< of each child, as in the tile
  std::uint32_t tile;
  std::uint32_t owner;  ///< the index that the tile is of, by the number that gather() was told
};

/// All that lies in a box, that of each index together.
struct Roots {
  static constexpr int most_roots = 8;
  std::array<Root, most_roots> root;
  int count = 0;
};

}  // namespace roam::index
