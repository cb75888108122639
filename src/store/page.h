#pragma once
/// \file
/// A page of the index: the tiles of a shard (at most page_tiles), their places, and a tree over their boxes. The bytes
/// on disk and in memory are the same, little endian; docs/format.md has the layout.

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
/// Cells along each axis of a tile's box in its mask of occupied cells.
inline constexpr int mask_cells = 8;

/// Greatest size of a page with this many tiles, which has at most as many nodes as tiles.
[[nodiscard]] constexpr std::uint64_t most_page_bytes(std::uint32_t tiles) { return 128 + std::uint64_t{tiles} * 328; }

/// The place of a tile, and the facts that do not need the tile itself.
struct TileEntry {
  double origin[3];  ///< metres: origin of its grid, see index::Tile
  double lower[3];   ///< metres: its box holds all triangles, both source and stored ones
  double upper[3];
  float step;   ///< metres
  float error;  ///< see index::Tile
  float fine_error;
  std::uint32_t triangles;
  std::uint64_t offset;  ///< offset of its bytes in the pack
  std::uint32_t bytes;
  std::uint32_t number_bytes;  ///< size of its source numbers, which follow its bytes
  std::uint64_t hash;          ///< XXH3 of its bytes
  std::uint64_t number_hash;   ///< XXH3 of its source numbers
  std::uint64_t geometry_hash;
  std::uint16_t nodes;
  std::uint16_t leaves;
  std::uint16_t fine;  ///< 0 or 1
  std::uint16_t zero;
  /// Bit x + 8 y + 64 z stands for cell (x, y, z), counted from `lower`. It is set if a triangle, source or stored, may
  /// touch the cell.
  std::uint64_t mask[mask_cells * mask_cells * mask_cells / 64];
};
static_assert(sizeof(TileEntry) == 200);

[[nodiscard]] inline Box box_of(const TileEntry& t) {
  return {{t.lower[0], t.lower[1], t.lower[2]}, {t.upper[0], t.upper[1], t.upper[2]}};
}
[[nodiscard]] inline TileShape shape_of(const TileEntry& t) { return {t.triangles, t.nodes, t.leaves, t.fine != 0}; }

/// The bytes of a page over these tiles (1 to page_tiles), and the order of its entries: entry i of the page is
/// tiles[order[i]].
struct EncodedPage {
  std::vector<std::byte> bytes;
  std::vector<std::uint32_t> order;
};
[[nodiscard]] EncodedPage encode_page(std::span<const TileEntry> tiles);

/// A page in memory, as read. The bytes must outlive the view and be aligned to 128.
struct PageView {
  index::Grid grid;                    ///< grid of the nodes
  std::span<const index::Node> nodes;  ///< root first; leaves are indices in `tiles`
  std::span<const TileEntry> tiles;
};
/// Checks everything that a traversal relies on: counts, child numbers, boxes, shapes that fit tile_bytes, finite
/// values, and tiles within the first `pack_bytes` bytes. Returns null, or the reason why the bytes are not a page.
/// Never allocates.
[[nodiscard]] const char* view_page(std::span<const std::byte> bytes, std::uint64_t pack_bytes, PageView& view);

}  // namespace roam::store
