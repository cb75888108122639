#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "index/grid.h"
#include "store/codec/tile_codec.h"

namespace roam::store {
namespace {

/// Exponent of the unit of the hash: 2^-16 of a step of the finest grid, 2^-35 m.
constexpr int unit_exponent = index::finest_exponent - 16;

using Corner = std::array<std::uint64_t, 3>;

}  // namespace

std::uint64_t geometry_hash(const index::Tile& tile, std::span<const index::Leaf> leaves,
                            std::span<const index::FineLeaf> fine) {
  const int shift = std::ilogb(tile.step) - unit_exponent - 16;  // from steps / 65536 to units, never negative
  Corner origin;
  for (int k = 0; k < 3; ++k) {
    const double steps = tile.origin[k] / double(tile.step);  // whole
    origin[k] = static_cast<std::uint64_t>(static_cast<std::int64_t>(steps)) << (shift + 16);
  }
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const index::Leaf& leaf = leaves[i];
    std::array<Corner, index::node_width> vertices;
    for (int v = 0; v < index::node_width; ++v) {
      for (int k = 0; k < 3; ++k) {
        std::uint64_t at = std::uint64_t{leaf.vertex[k][v]} << 16;
        if (tile.fine) at += static_cast<std::uint64_t>(std::int64_t{fine[i].vertex[k][v]});
        vertices[v][k] = origin[k] + (at << shift);
      }
    }
    for (int t = 0; t < leaf.triangle_count; ++t) {
      const Corner &a = vertices[leaf.vertex_of(0, t)], &b = vertices[leaf.vertex_of(1, t)],
                   &c = vertices[leaf.vertex_of(2, t)];
      using Corners = std::array<Corner, 3>;
      const Corners corners = std::min({Corners{a, b, c}, Corners{b, c, a}, Corners{c, a, b}});
      sum += XXH3_64bits(corners.data(), sizeof(corners));
    }
  }
  return sum;
}

}  // namespace roam::store
