#include "store/tile_view.h"

#include "index/grid.h"

namespace roam::store {

index::Tile absent_tile(const TileEntry& entry) {
  index::Tile tile{};
  tile.origin = {entry.origin[0], entry.origin[1], entry.origin[2]};
  tile.step = entry.step;
  tile.error = entry.error;
  tile.fine_error = entry.fine_error;
  tile.fine = entry.fine != 0;
  tile.nodes = index::Tile::absent_leaf;
  return tile;
}

TileView view_tile(const TileEntry& entry, std::span<const std::byte> decoded) {
  TileView view{absent_tile(entry), {}, {}};
  view.tile.nodes = 0;
  view.tile.leaves = entry.nodes;
  const std::byte* const leaves = decoded.data() + entry.nodes * sizeof(index::Block);
  view.leaves = {reinterpret_cast<const index::Leaf*>(leaves), entry.leaves};
  if (view.tile.fine) {
    const std::byte* const fine = leaves + entry.leaves * sizeof(index::Block);
    view.fine = {reinterpret_cast<const index::FineLeaf*>(fine), entry.leaves};
  }
  return view;
}

Triangle stored_triangle(const index::Tile& tile, const index::Leaf& leaf, const index::FineLeaf* fine, int triangle) {
  Triangle out;
  const double step = tile.step;
  for (int c = 0; c < 3; ++c) {
    const int v = leaf.vertex_of(c, triangle);
    for (int k = 0; k < 3; ++k) {
      const double low = fine != nullptr ? step / double(index::fine_steps) * fine->vertex[k][v] : 0.0;
      out[static_cast<std::size_t>(c)][k] = tile.origin[k] + (step * leaf.vertex[k][v] + low);
    }
  }
  return out;
}

}  // namespace roam::store
