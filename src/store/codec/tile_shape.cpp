#include "store/codec/tile_codec.h"

namespace roam::store {

TileShape shape_of(const index::BuiltTile& tile) {
  TileShape shape;
  for (const index::Leaf& leaf : tile.leaves) shape.triangles += leaf.triangle_count;
  shape.nodes = static_cast<std::uint32_t>(tile.nodes.size());
  shape.leaves = static_cast<std::uint32_t>(tile.leaves.size());
  shape.fine = tile.tile.fine;
  return shape;
}

}  // namespace roam::store
