#pragma once
/// \file
/// Roots of searches that stay in a box: they begin below the tree over tiles and below the upper levels of each tile.

#include <array>
#include <cstdint>

#include "index/block.h"

namespace roam::index {

/// A node made for a box from the nodes and leaves of one tile that meet it. Its child boxes are clipped to the box.
struct Root {
  Node node;                                     ///< its first_node and first_leaf have no meaning
  std::array<std::uint32_t, node_width> number;  ///< of each child, as in the tile
  std::uint32_t tile;
  std::uint32_t owner;  ///< number of the index that the tile belongs to, as passed to gather()
};

/// The contents of a box, for all indexes together.
struct Roots {
  static constexpr int most_roots = 8;
  std::array<Root, most_roots> root;
  int count = 0;
};

}  // namespace roam::index
