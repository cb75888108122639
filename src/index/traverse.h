#pragma once
/// \file
/// The two traversals of the tree: the first impact of a sweep, and all triangles within a distance.
///
/// A float filter tests sixteen boxes or triangles at a time and drops only those that are certainly out of reach. The
/// rest is decided by the certified functions of src/sweep in double precision.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "index/block.h"
#include "index/grid.h"
#include "index/margin.h"
#include "index/roots.h"
#include "roam/sweep.h"
#include "sweep/certified.h"

namespace roam::index {

/// In an index without id streams: the bits of a triangle's number that count within its tile.
inline constexpr int tile_triangle_bits = 14;

/// Callbacks for tiles that are not in memory, in place of their triangles.
struct Absent {
  /// The time of the piece at which tile `tile` is met; a time >= `until` if it is not met before.
  double (*sweep)(void* context, std::uint32_t tile, double until);
  /// Reports the nearness of tile `tile`; returns like Visit.
  double (*near)(void* context, std::uint32_t tile);
  void* context;
  double margin;      ///< metres to keep from such tiles in addition to the radius
  bool only = false;  ///< tiles that are in memory are passed over
};

/// Storage place of a triangle.
struct Place {
  std::uint32_t tile = 0;
  std::uint32_t leaf = 0;  ///< block in the arena
  std::uint32_t triangle = 0;
};

/// Filter of triangles; true means that the triangle is skipped.
struct Skip {
  bool (*skips)(const void* context, const Place& place);
  const void* context;
};

/// A tree over tiles and the tiles, as one read-only view.
struct Index {
  const Block* top = nullptr;     ///< top[0] is the root over all tiles; its leaves count in `tiles`
  const Tile* tiles = nullptr;    ///< null if there is no triangle
  const Block* blocks = nullptr;  ///< base of the tiles' node and leaf numbers
  const std::byte* fine = nullptr;
  const std::uint8_t* ids = nullptr;  ///< null: triangle i of a leaf of tile t is number t << 14 | leaf.ids + i
  Grid grid;                          ///< grid of the nodes over tiles
  const Absent* absent = nullptr;     ///< null if no tile is absent
  const Skip* skip = nullptr;         ///< null if every triangle counts
};

/// One straight piece of a motion, at most longest_piece long, whose start is within reach of the index.
struct Piece {
  Body body;
  Vec3 start;
  Vec3 motion;
};

struct Impact {
  bool hit = false;
  double time = 1.0;  ///< fraction of the piece
  Place place;        ///< if the tile is absent, only `tile` has a meaning
};

/// The first impact before `until` with a stored triangle, grown by its tile's error, or with an absent tile. Ignores
/// Index::skip (see rest.h).
[[nodiscard]] Impact first_impact(const Index& index, const Piece& piece, double until = 1.0);

/// Thin spheres are swept as rays.
[[nodiscard]] inline bool is_thin(const Body& body) { return body.half_height == 0.0 && body.radius < thin_body; }

/// Adds the parts of an index that meet a box of at most a few tens of metres, so that first_impact() and visit_near()
/// of pieces within the box begin there. `owner` is the caller's number of the index. Returns false, with `out`
/// undefined, if there are too many tiles or one is absent.
[[nodiscard]] bool gather(const Index& index, std::uint32_t owner, const Box& box, Roots& out);

/// The first impact as above, beginning at the gathered roots of this index. The body must stay in their box, including
/// all errors of tiles. The piece is at most short_motion long, and the body is not thin.
[[nodiscard]] Impact first_impact(const Index& index, std::span<const Root> roots, const Piece& piece,
                                  double until = 1.0);

/// Distance between a stored triangle and the body's axis during its motion, metres.
struct Nearness {
  float least;  ///< certified lower bound
  float most;   ///< estimate of an upper bound
};

/// Receives a triangle that may be near. Returns the reach from now on: metres from the body's surface, never more than
/// before.
using Visit = double (*)(void* context, const Place& place, const Nearness& near);

/// The triangles that visit_near() looks for.
struct Near {
  double reach;       ///< metres from the body's surface
  double part = 0.0;  ///< Nearness::least may lose this part of the gap, which saves time
  /// Metres above the start of the piece. Unless infinite, triangles entirely below or above may be left out.
  double lowest = -std::numeric_limits<double>::infinity(), highest = std::numeric_limits<double>::infinity();
};

/// Visits all triangles that are looked for during the piece, each at least once, roughly nearest first. Triangles are
/// grown by their tile's error, as above; absent tiles are reported too. Returns a lower bound of the distance of all
/// others within the heights from the surface, metres.
double visit_near(const Index& index, const Piece& piece, const Near& near, Visit visit, void* context);

/// The same, beginning at gathered roots. Everything within the reach must lie in their box too.
double visit_near(const Index& index, std::span<const Root> roots, const Piece& piece, const Near& near, Visit visit,
                  void* context);

/// The low bits of a tile's leaves, in their order; null if the tile has none.
[[nodiscard]] inline const FineLeaf* fine_leaves(const Index& index, const Tile& tile) {
  return tile.fine ? reinterpret_cast<const FineLeaf*>(index.fine + tile.fine_leaves) : nullptr;
}

/// The stored triangle in coordinates relative to `start`.
[[nodiscard]] certified::LocalTriangle local_triangle(const Index& index, const Place& place, const Vec3& start);

/// Metres. Greatest distance of a source vertex of the tile from its stored one, with all stored bits.
[[nodiscard]] inline double stored_error(const Tile& tile) { return double(tile.fine_error); }

}  // namespace roam::index
