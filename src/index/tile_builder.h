#pragma once
/// \file
/// Construction of the blocks of one tile.

#include <cstdint>
#include <span>
#include <vector>

#include "index/block.h"
#include "index/soup.h"

namespace roam::index {

/// A tile on its own: offsets in `tile` and in the blocks count from the tile's beginning.
struct BuiltTile {
  Tile tile;
  Box bounds;               ///< of the source triangles
  std::vector<Node> nodes;  ///< the root first
  std::vector<Leaf> leaves;
  std::vector<FineLeaf> fine_leaves;  ///< one per leaf if tile.fine, else none
  std::vector<std::uint8_t> ids;
};

/// Builds a tile of the triangles with these numbers (ascending, 1 to 16384 of them). The low bits are kept if whole
/// steps would be larger than ordinary_step, and always if `lossless`.
[[nodiscard]] BuiltTile build_tile(const Soup& soup, std::span<const std::uint32_t> ids, bool lossless);

/// The same for given triangles; ids[i], ascending, is the number of triangles[i].
[[nodiscard]] BuiltTile build_tile(std::span<const Triangle> triangles, std::span<const std::uint32_t> ids,
                                   bool lossless);

/// The number of triangle i of a leaf, read from its tile's id stream.
[[nodiscard]] std::uint32_t read_id(const std::uint8_t* tile_ids, const Leaf& leaf, int i);

}  // namespace roam::index
