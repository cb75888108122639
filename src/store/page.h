#pragma once
/// \file
/// A page of the index: the tiles of a shard (at most page_tiles of them), where they are, and a tree over their boxes.
/// The same bytes on disk and in memory, little endian; docs/format.md has the layout.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "index/block.h"
#include "index/grid.h"
#include "roam/math.h"
#include "store/codec/tile_codec.h"

namespace roam::store {

inline constexpr std::uint32_t page_tiles = 1024;
/// Cells of a tile's box along each axis in its mask of occupied cells.
inline constexpr int mask_cells = 8;

/// Of a page of so many tiles: as many nodes as tiles.
[[nodiscard]] constexpr std::uint64_t most_page_bytes(std::uint32_t tiles) { return 128 + std::uint64_t{tiles} * 328; }

/// Where a tile is and what is known of it without it.
struct TileEntry {
  double origin[3];  ///< of its grid, metres: see index::Tile
  double lower[3];   ///< its box, metres: all triangles, of the source and as stored, are in it
  double upper[3];
  float step;   ///< metres
  float error;  ///< see index::Tile
  float fine_error;
  std::uint32_t triangles;
  std::uint64_t offset;  ///< of its bytes in the pack of the page
  std::uint32_t bytes;
  std::uint32_t number_bytes;  ///< of its source numbers, which follow its bytes
  std::uint64_t hash;          ///< XXH3 of its bytes
  std::uint64_t number_hash;   ///< XXH3 of its source numbers
  std::uint64_t geometry_hash;
  std::uint16_t nodes;
  std::uint16_t leaves;
  std::uint16_t fine;  ///< 0 or 1
  std::uint16_t zero;
  /// Bit x + 8 y + 64 z of cell (x, y, z), counted from `lower`: whether a triangle, of the source or as stored, may
  /// touch the cell.
  std::uint64_t mask[mask_cells * mask_cells * mask_cells / 64];
};
static_assert(sizeof(TileEntry) == 200);

[[nodiscard]] inline Box box_of(const TileEntry& t) {
  return {{t.lower[0], t.lower[1], t.lower[2]}, {t.upper[0], t.upper[1], t.upper[2]}};
}
[[nodiscard]] inline TileShape shape_of(const TileEntry& t) { return {t.triangles, t.nodes, t.leaves, t.fine != 0}; }

/// The bytes of a page over these tiles (1 to page_tiles), and the order in which it holds them: entry i of the page is
/// tiles[order[i]].
struct EncodedPage {
  std::vector<std::byte> bytes;
  std::vector<std::uint32_t> order;
};
[[nodiscard]] EncodedPage encode_page(std::span<const TileEntry> tiles);

/// A page in memory, as it was read. The bytes must stay, aligned to 128.
struct PageView {
  index::Grid grid;                    ///< of the nodes
  std::span<const index::Node> nodes;  ///< the root first; leaves count in `tiles`
  std::span<const TileEntry> tiles;
};
/// Checks everything that a traversal relies on: counts, child numbers, boxes, shapes that fit tile_bytes, values that
/// are finite, that tiles lie in the first `pack_bytes` bytes. Returns null, or why these bytes are no page. Never
/// allocates.
[[nodiscard]] const char* view_page(std::span<const std::byte> bytes, std::uint64_t pack_bytes, PageView& view);

}  // namespace roam::store
