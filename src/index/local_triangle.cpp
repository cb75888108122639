#include <algorithm>
#include <cmath>

#include "index/traverse.h"

namespace roam::index {
namespace {

/// Sets the corners; `low_of` gives what a coordinate of a vertex has beyond its whole steps, metres.
template <class LowOf>
[[gnu::always_inline]] inline void set_corners(const Leaf& leaf, std::uint32_t triangle, double step,
                                               const Vec3& offset, const LowOf& low_of, certified::LocalTriangle& out) {
  double largest = std::max({std::abs(offset.x), std::abs(offset.y), std::abs(offset.z)});
  for (int c = 0; c < 3; ++c) {
    const int v = leaf.vertex_of(c, static_cast<int>(triangle));
    for (int k = 0; k < 3; ++k) {
      out.corner[c][k] = offset[k] + (step * leaf.vertex[k][v] + low_of(k, v));
      largest = std::max(largest, std::abs(out.corner[c][k]));
    }
  }
  // Two roundings, of the offset and of the sum; whole and low part together have at most 33 bits.
  out.corner_error = 0x1p-52 * largest;
}

}  // namespace

certified::LocalTriangle local_triangle(const Index& index, const Place& place, const Vec3& start) {
  const Tile& tile = index.tiles[place.tile];
  const Leaf& leaf = index.blocks[place.leaf].leaf;
  const double step = tile.step;
  const Vec3 offset = tile.origin - start;
  certified::LocalTriangle out{};
  if (!tile.fine) {
    set_corners(
        leaf, place.triangle, step, offset, [](int, int) { return 0.0; }, out);
    return out;
  }
  const auto* const low = reinterpret_cast<const FineLeaf*>(index.fine + tile.fine_leaves) + (place.leaf - tile.leaves);
  const double fine = step / double(fine_steps);
  set_corners(
      leaf, place.triangle, step, offset, [&](int k, int v) { return fine * low->vertex[k][v]; }, out);
  return out;
}

}  // namespace roam::index
