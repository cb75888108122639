#pragma once
/// \file
/// The blocks of a tile in memory: each is 128 bytes (two cache lines) and holds one node or one leaf. A traversal
/// reads nothing else.
///
/// All coordinates are whole steps of the tile's grid. So bounds and vertices are exact integers until they are
/// subtracted from the start of a query.

#include <array>
#include <cstdint>

#include "roam/math.h"

namespace roam::index {

/// Children of a node, and triangles and vertices of a leaf: one lane each of the widest vector unit.
inline constexpr int node_width = 16;

/// Sixteen child boxes on a grid of their own: child i spans origin + (lower[k][i] .. upper[k][i]) << shift[k] steps.
/// The first inner_count children are nodes, consecutive from first_node. The others are leaves, consecutive from
/// first_leaf; in the tree over tiles they are tiles.
struct Node {
  std::uint8_t lower[3][node_width];
  std::uint8_t upper[3][node_width];
  std::int32_t origin[3];
  std::uint32_t first_node;
  std::uint32_t first_leaf;
  std::uint8_t shift[3];
  std::uint8_t child_count;
  std::uint8_t inner_count;
  std::uint8_t unused[7];
};
static_assert(sizeof(Node) == 128);

/// Up to sixteen triangles over up to sixteen vertices. Corner k of triangle i is vertex number
/// (corner[k][i / 8] >> 4 * (i % 8)) & 15. Unused triangles repeat the first one.
struct Leaf {
  std::uint16_t vertex[3][node_width];
  std::uint32_t corner[3][2];
  std::uint8_t triangle_count;
  std::uint8_t id_bytes;  ///< bytes per id in the tile's id stream, after a base of four bytes
  std::uint8_t unused[2];
  std::uint32_t ids;  ///< offset in the tile's id stream

  [[nodiscard]] int vertex_of(int k, int triangle) const {
    return static_cast<int>(corner[k][triangle / 8] >> (4 * (triangle % 8)) & 15U);
  }
};
static_assert(sizeof(Leaf) == 128);

union alignas(128) Block {
  Node node;
  Leaf leaf;
};
static_assert(sizeof(Block) == 128);

/// The low 16 bits, signed, of the vertices of one leaf of a fine tile, in 1/65536 of the tile's step.
struct FineLeaf {
  std::int16_t vertex[3][node_width];
};

/// A cube of space with its own grid: vertex v lies at origin + step * v.
struct Tile {
  Vec3 origin;                ///< metres, a multiple of step on each axis
  float step;                 ///< metres, a power of two
  float error;                ///< metres: greatest distance of a source vertex from its stored one (16 bits)
  float fine_error;           ///< the same with the low 16 bits; equal to error if there are none
  bool fine;                  ///< the tile has low bits, and double precision uses them
  std::uint32_t nodes;        ///< first node in the arena, the root; absent_leaf if the tile is not in memory
  std::uint32_t leaves;       ///< first leaf in the arena
  std::uint64_t fine_leaves;  ///< first byte of its FineLeafs, if fine
  std::uint64_t ids;          ///< first byte of its id stream

  static constexpr std::uint32_t absent_leaf = UINT32_MAX;
  [[nodiscard]] bool absent() const { return nodes == absent_leaf; }
};
static_assert(sizeof(Tile) == 64);

/// A box in grid steps, both ends included.
struct StepBox {
  std::array<std::int32_t, 3> lower{INT32_MAX, INT32_MAX, INT32_MAX};
  std::array<std::int32_t, 3> upper{INT32_MIN, INT32_MIN, INT32_MIN};

  void include(const StepBox& b) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = b.lower[k] < lower[k] ? b.lower[k] : lower[k];
      upper[k] = b.upper[k] > upper[k] ? b.upper[k] : upper[k];
    }
  }
  /// Half the surface area of the box in square steps, with each side `margin` steps longer.
  [[nodiscard]] double half_area(double margin) const {
    const double x = double(upper[0]) - lower[0] + margin, y = double(upper[1]) - lower[1] + margin,
                 z = double(upper[2]) - lower[2] + margin;
    return x * y + y * z + z * x;
  }
};

}  // namespace roam::index
