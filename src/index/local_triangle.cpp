#include <algorithm>
#include <cmath>

#include "index/traverse.h"

namespace roam::index {
namespace {

/// `coordinate(k, v)`: coordinate k of the leaf's vertex v, metres from the tile's origin.
template <class Coordinate>
[[gnu::always_inline]] inline certified::LocalTriangle placed(const Leaf& leaf, std::uint32_t triangle,
                                                              const Vec3& offset, const Coordinate& coordinate) {
  certified::LocalTriangle out;
  double largest = std::max({std::abs(offset.x), std::abs(offset.y), std::abs(offset.z)});
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    const int v = leaf.vertex_of(c, static_cast<int>(triangle));
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k) {
      out.corner[c][k] = offset[k] + coordinate(k, v);
      largest = std::max(largest, std::abs(out.corner[c][k]));
    }
  }
  // Two roundings, of the offset and of the sum; a coordinate has at most 33 bits.
  out.corner_error = 0x1p-52 * largest;
  return out;
}

}  // namespace

certified::LocalTriangle local_triangle(const Index& index, const Place& place, const Vec3& start) {
  const Tile& tile = index.tiles[place.tile];
  const Leaf& leaf = index.blocks[place.leaf].leaf;
  const double step = tile.step;
  const Vec3 offset = tile.origin - start;
  const FineLeaf* const all = fine_leaves(index, tile);
  if (all == nullptr)
    return placed(leaf, place.triangle, offset, [&](int k, int v) { return step * leaf.vertex[k][v]; });
  const FineLeaf* const low = all + (place.leaf - tile.leaves);
  const double fine = step / double(fine_steps);
  return placed(leaf, place.triangle, offset,
                [&](int k, int v) { return step * leaf.vertex[k][v] + fine * low->vertex[k][v]; });
}

}  // namespace roam::index
