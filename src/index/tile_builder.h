#pragma once
/// \file
/// Makes the blocks of one tile.

#include <cstdint>
#include <span>
#include <vector>

#include "index/block.h"
#include "index/soup.h"

namespace roam::index {

/// A tile on its own: offsets in `tile` and in the blocks count from its own beginning.
struct BuiltTile {
  Tile tile;
  Box bounds;               ///< of the source triangles
  std::vector<Node> nodes;  ///< the root first
  std::vector<Leaf> leaves;
  std::vector<FineLeaf> fine_leaves;  ///< one a leaf when tile.fine, else none
  std::vector<std::uint8_t> ids;
};

/// Builds a tile of the triangles whose numbers are given (ascending, 1 to 16384). The low bits are
/// kept where the whole ones would move a vertex by more than ordinary_step allows, and everywhere when `lossless`.
[[nodiscard]] BuiltTile build_tile(const Soup& soup, std::span<const std::uint32_t> ids, bool lossless);

/// The same for triangles wherever they come from; ids[i], ascending, is the number of triangles[i].
[[nodiscard]] BuiltTile build_tile(std::span<const Triangle> triangles, std::span<const std::uint32_t> ids,
                                   bool lossless);

/// The number of triangle i of a leaf, read from its tile's id stream.
[[nodiscard]] std::uint32_t read_id(const std::uint8_t* tile_ids, const Leaf& leaf, int i);

}  // namespace roam::index
