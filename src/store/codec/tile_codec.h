#pragma once
/// \file
/// A tile as bytes on disk, and back into the very blocks that a traversal reads.
///
/// What is kept: the vertices of the leaves, their triangles, how many children each node has. The boxes of the nodes
/// are computed again when a tile is decoded (refit), by the functions that the builder uses, so that what is decoded
/// equals what was built to the last bit. docs/format.md describes the bytes.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "index/block.h"
#include "index/tile_builder.h"

namespace roam::store {

/// How much a tile takes in memory: what its entry in the index says, and what its bytes must agree with.
struct TileShape {
  std::uint32_t triangles = 0;  ///< 1 to index::most_tile_triangles
  std::uint32_t nodes = 0;
  std::uint32_t leaves = 0;
  bool fine = false;

  /// Nodes, then leaves, then fine leaves; a multiple of 128.
  [[nodiscard]] std::size_t bytes() const {
    const std::size_t blocks = (std::size_t{nodes} + leaves) * sizeof(index::Block);
    return blocks + (fine ? (leaves * sizeof(index::FineLeaf) + 127) / 128 * 128 : 0);
  }
};

/// No tile of a store takes more memory than this; the builder divides what would.
inline constexpr std::size_t tile_bytes = 256 << 10;

[[nodiscard]] TileShape shape_of(const index::BuiltTile& tile);

/// The tile's bytes, the same on every machine. Puts the vertices and the triangles of each leaf, and the ids with
/// them, into the order in which decoding brings them back, and starts each triangle with the corner that decoding
/// gives first: what `tile` then holds is decoded bit for bit, but for the ids. In leaves of stores `ids` is the
/// number, in the tile, of the leaf's first triangle, and id_bytes is 0; the id stream of the tile is not encoded. The
/// tile takes no more than tile_bytes.
[[nodiscard]] std::vector<std::byte> encode_tile(index::BuiltTile& tile);

/// Decodes tiles. Holds all the memory that it needs from the start; one thread at a time.
class TileDecoder {
 public:
  TileDecoder();
  ~TileDecoder();

  /// Fills `out` (shape.bytes() bytes, aligned to 128) with what `coded` holds. Whatever the bytes are, writes nothing
  /// but `out`, and what it writes there leads no traversal out of the tile. Returns null, or why the bytes are no such
  /// tile. Never allocates, never throws.
  [[nodiscard]] const char* decode(std::span<const std::byte> coded, const TileShape& shape, std::span<std::byte> out);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Which triangle of the source a stored one is.
struct SourceNumber {
  std::uint64_t part = 0;    ///< hash of the name of the part of the scene
  std::uint64_t number = 0;  ///< in that part, in the order of the file
  bool operator==(const SourceNumber&) const = default;
};

/// The source numbers of a tile's triangles, in the order of the tile, as bytes; and back. decode throws roam::Error
/// for bytes that are not those of `triangles` numbers.
/// Bytes: no tile's numbers take more, packed or not.
[[nodiscard]] constexpr std::uint64_t most_number_bytes(std::uint32_t triangles) {
  return 64 * (std::uint64_t{triangles} + 1);
}
[[nodiscard]] std::vector<std::byte> encode_numbers(std::span<const SourceNumber> numbers);
[[nodiscard]] std::vector<SourceNumber> decode_numbers(std::span<const std::byte> coded, std::uint32_t triangles);

/// The sum, modulo 2^64, of a hash of each triangle of the tile as it is stored: its corners as multiples of 2^-35 m
/// from the scene's zero, modulo 2^64, orientation kept, whichever corner is first. Sums of tiles add up to that of the
/// scene, in any order.
[[nodiscard]] std::uint64_t geometry_hash(const index::Tile& tile, std::span<const index::Leaf> leaves,
                                          std::span<const index::FineLeaf> fine);

}  // namespace roam::store
