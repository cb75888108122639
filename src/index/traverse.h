#pragma once
/// \file
/// The two ways through the tree: the first impact of a sweep, and everything within a distance.
///
/// A float filter, sixteen boxes or triangles at a time, drops only what is certainly out of reach; what it cannot
/// settle goes to the certified functions of the sweep room, in double precision.

#include <cstdint>

#include "index/block.h"
#include "index/grid.h"
#include "roam/sweep.h"
#include "sweep/certified.h"

namespace roam::index {

/// A tree over tiles and the tiles, as one read-only view.
struct Index {
  const Block* blocks = nullptr;  ///< blocks[0] is the root over all tiles; its leaves count in `tiles`
  const Tile* tiles = nullptr;    ///< null when there is no triangle
  const FineLeaf* fine = nullptr;
  const std::uint8_t* ids = nullptr;
  Grid grid;  ///< of the nodes over tiles
};

/// Where a triangle is stored.
struct Place {
  std::uint32_t tile = 0;
  std::uint32_t leaf = 0;  ///< block in the arena
  std::uint32_t triangle = 0;
};

/// One straight piece of a motion, at most kLongestPiece long, from a start in reach of the index.
struct Piece {
  Body body;
  Vec3 start;
  Vec3 motion;
};

struct Impact {
  bool hit = false;
  double time = 1.0;  ///< of the piece
  Place place;
};

/// The first impact with any stored triangle, each grown by its tile's error.
[[nodiscard]] Impact first_impact(const Index& index, const Piece& piece);

/// Receives a triangle that may be near and returns how near others must be to matter, from now on: metres from the
/// body's surface, never more than before.
using Visit = double (*)(void* context, const Place& place);

/// Visits all triangles that may come within `reach` (m) of the body's surface somewhere along the piece, each at
/// least once, roughly nearest first for a piece without motion. Grown by the tile's error as above.
void visit_near(const Index& index, const Piece& piece, double reach, Visit visit, void* context);

/// The stored triangle as seen from `start`.
[[nodiscard]] certified::LocalTriangle local_triangle(const Index& index, const Place& place, const Vec3& start);

/// How far any source vertex of that tile may lie from the stored one, with all bits that it has (m).
[[nodiscard]] inline double stored_error(const Tile& tile) { return double(tile.fine_error); }

}  // namespace roam::index
