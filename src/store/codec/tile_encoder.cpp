#include <zstd.h>

#include "roam/error.h"
#include "store/codec/tile_codec.h"
#include "store/codec/tree_shape.h"

namespace roam::store {

std::vector<std::byte> encode_tile(index::BuiltTile& tile) {
  std::vector<std::byte> raw;
  const auto put = [&raw](const auto& value) {
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    raw.insert(raw.end(), bytes, bytes + sizeof(value));
  };
  visit_depth_first(tile.nodes, 0, [&](const index::Node& n) { put(node_counts(n)); });
  for (std::size_t i = 0; i < tile.leaves.size(); ++i) {
    const index::Leaf& leaf = tile.leaves[i];
    put(leaf.vertex);
    put(leaf.corner);
    put(leaf.triangle_count);
    if (tile.tile.fine) put(tile.fine_leaves[i]);
  }
  std::vector<std::byte> coded(ZSTD_compressBound(raw.size()));
  const std::size_t size = ZSTD_compress(coded.data(), coded.size(), raw.data(), raw.size(), 3);
  if (ZSTD_isError(size) != 0) throw Error("cannot compress a tile: " + std::string(ZSTD_getErrorName(size)));
  coded.resize(size);
  return coded;
}

}  // namespace roam::store
