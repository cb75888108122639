#include <algorithm>
#include <cmath>

#include "index/traverse.h"

namespace roam::index {

certified::LocalTriangle local_triangle(const Index& index, const Place& place, const Vec3& start) {
  const Tile& tile = index.tiles[place.tile];
  const Leaf& leaf = index.blocks[place.leaf].leaf;
  const FineLeaf* low =
      tile.fine ? reinterpret_cast<const FineLeaf*>(index.fine + tile.fine_leaves) + (place.leaf - tile.leaves)
                : nullptr;
  const double step = tile.step;
  const Vec3 offset = tile.origin - start;
  certified::LocalTriangle out{};
  double largest = 0.0;
  for (int c = 0; c < 3; ++c) {
    const int v = leaf.vertex_of(c, static_cast<int>(place.triangle));
    for (int k = 0; k < 3; ++k) {
      const double whole = step * leaf.vertex[k][v];
      const double fraction = low ? step / double(fine_steps) * low->vertex[k][v] : 0.0;
      out.corner[c][k] = offset[k] + (whole + fraction);
      largest = std::max(largest, std::max(std::abs(offset[k]), std::abs(out.corner[c][k])));
    }
  }
  // Two roundings, of the offset and of the sum; whole + fraction has at most 33 bits.
  out.corner_error = 0x1p-52 * largest;
  return out;
}

}  // namespace roam::index
