#pragma once
/// \file
/// A tile as bytes on disk, and back into the blocks that a traversal reads.
///
/// The bytes hold the vertices of the leaves, their triangles, and the number of children of each node. Decoding
/// computes the boxes of the nodes again (refit), by the functions that the builder uses. Therefore the decoded tile
/// equals the built one to the last bit. docs/format.md describes the bytes.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "index/block.h"
#include "index/tile_builder.h"

namespace roam::store {

/// The counts of a tile, which determine its size in memory. Its entry in the index says them, and its bytes must
/// agree.
struct TileShape {
  std::uint32_t triangles = 0;  ///< 1 to index::most_tile_triangles
  std::uint32_t nodes = 0;
  std::uint32_t leaves = 0;
  bool fine = false;

  /// Bytes in memory: nodes, then leaves, then fine leaves; a multiple of 128.
  [[nodiscard]] std::size_t bytes() const {
    const std::size_t blocks = (std::size_t{nodes} + leaves) * sizeof(index::Block);
    return blocks + (fine ? (leaves * sizeof(index::FineLeaf) + 127) / 128 * 128 : 0);
  }
};

/// Upper bound of a stored tile in memory, in bytes. The builder divides larger tiles.
inline constexpr std::size_t tile_bytes = 256 << 10;

[[nodiscard]] TileShape shape_of(const index::BuiltTile& tile);

/// The tile's bytes, the same on every machine. Reorders the vertices, triangles and ids of each leaf as decoding
/// returns them, and rotates each triangle to start with the corner that decoding gives first. After the call, decoding
/// gives `tile` bit for bit, except the ids: in leaves of stores `ids` is the number, in the tile, of the leaf's first
/// triangle, and id_bytes is 0. The id stream of the tile is not encoded. Throws roam::Error if the tile takes more
/// than tile_bytes.
[[nodiscard]] std::vector<std::byte> encode_tile(index::BuiltTile& tile);

/// Decodes tiles. Allocates all its memory in the constructor. One thread at a time.
class TileDecoder {
 public:
  TileDecoder();
  ~TileDecoder();

  /// Decodes `coded` into `out`, which has shape.bytes() bytes, aligned to 128. For any bytes it writes only to `out`,
  /// and no traversal of the result leaves the tile. Returns null, or the reason why the bytes are no such tile. Never
  /// allocates, never throws.
  [[nodiscard]] const char* decode(std::span<const std::byte> coded, const TileShape& shape, std::span<std::byte> out);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The number of a stored triangle in its source.
struct SourceNumber {
  std::uint64_t part = 0;    ///< hash of the name of the scene's part
  std::uint64_t number = 0;  ///< in that part, in the order of the file
  bool operator==(const SourceNumber&) const = default;
};

/// Upper bound, in bytes, of the source numbers of `triangles` triangles, packed or not.
[[nodiscard]] constexpr std::uint64_t most_number_bytes(std::uint32_t triangles) {
  return 64 * (std::uint64_t{triangles} + 1);
}
/// The source numbers of a tile's triangles as bytes, in the order of the tile.
[[nodiscard]] std::vector<std::byte> encode_numbers(std::span<const SourceNumber> numbers);
/// The inverse of encode_numbers. Throws roam::Error unless `coded` holds exactly `triangles` numbers.
[[nodiscard]] std::vector<SourceNumber> decode_numbers(std::span<const std::byte> coded, std::uint32_t triangles);

/// The sum, modulo 2^64, of a hash of each stored triangle of the tile. Corners are multiples of 2^-35 m from the
/// scene's zero, modulo 2^64. The hash depends on orientation, but not on which corner is first. The sums of tiles add
/// up to that of the scene, in any order.
[[nodiscard]] std::uint64_t geometry_hash(const index::Tile& tile, std::span<const index::Leaf> leaves,
                                          std::span<const index::FineLeaf> fine);

}  // namespace roam::store
