#pragma once
/// \file
/// The two ways through the tree: the first impact of a sweep, and everything within a distance.
///
/// A float filter, sixteen boxes or triangles at a time, drops only what is certainly out of reach; what it cannot
/// settle goes to the certified functions of the sweep room, in double precision.

#include <cstddef>
#include <cstdint>
#include <span>

#include "index/block.h"
#include "index/grid.h"
#include "index/margin.h"
#include "index/roots.h"
#include "roam/sweep.h"
#include "sweep/certified.h"

namespace roam::index {

/// Of the number of a triangle of an index without id streams: those that count in its tile.
inline constexpr int tile_triangle_bits = 14;

/// Answers for tiles that are not in memory, in the place of their triangles.
struct Absent {
  /// The time of the piece at which tile `tile` is met; `until` or later when it is not met before.
  double (*sweep)(void* context, std::uint32_t tile, double until);
  /// Looks at what is near of tile `tile`; returns as Visit does.
  double (*near)(void* context, std::uint32_t tile);
  void* context;
  double margin;      ///< metres that are kept from such tiles, beside the radius
  bool only = false;  ///< tiles that are in memory are passed over
};

/// Where a triangle is stored.
struct Place {
  std::uint32_t tile = 0;
  std::uint32_t leaf = 0;  ///< block in the arena
  std::uint32_t triangle = 0;
};

/// Which triangles are passed over.
struct Skip {
  bool (*skips)(const void* context, const Place& place);
  const void* context;
};

/// A tree over tiles and the tiles, as one read-only view.
struct Index {
  const Block* top = nullptr;     ///< top[0] is the root over all tiles; its leaves count in `tiles`
  const Tile* tiles = nullptr;    ///< null when there is no triangle
  const Block* blocks = nullptr;  ///< what the tiles' nodes and leaves count in
  const std::byte* fine = nullptr;
  const std::uint8_t* ids = nullptr;  ///< null: triangle i of a leaf of tile t is number t << 14 | leaf.ids + i
  Grid grid;                          ///< of the nodes over tiles
  const Absent* absent = nullptr;     ///< null where no tile is
  const Skip* skip = nullptr;         ///< null where every triangle counts
};

/// One straight piece of a motion, at most longest_piece long, from a start in reach of the index.
struct Piece {
  Body body;
  Vec3 start;
  Vec3 motion;
};

struct Impact {
  bool hit = false;
  double time = 1.0;  ///< of the piece
  Place place;        ///< of which only `tile` means something where that is absent
};

/// Without Index::skip (see rest.h): the first impact before `until` with any stored triangle, each grown by its tile's
/// error, or absent tile.
[[nodiscard]] Impact first_impact(const Index& index, const Piece& piece, double until = 1.0);

/// Spheres so thin are asked about as rays are.
[[nodiscard]] inline bool is_thin(const Body& body) { return body.half_height == 0.0 && body.radius < thin_body; }

/// Adds what of an index, which its caller calls by the number `owner`, meets a box of a few tens of metres at most, so
/// that first_impact() and visit_near() of what stays in the box begin there. False where there are too many tiles or
/// one is absent: then `out` means nothing.
[[nodiscard]] bool gather(const Index& index, std::uint32_t owner, const Box& box, Roots& out);

/// The first impact as above, beginning at the roots of this index that were gathered for a box in which the body stays
/// with all errors of tiles. The piece is at most short_motion long, the body not thin.
[[nodiscard]] Impact first_impact(const Index& index, std::span<const Root> roots, const Piece& piece,
                                  double until = 1.0);

/// How near a stored triangle, without its low bits, comes to the body's axis on its way, metres.
struct Nearness {
  float least;  ///< certified: it comes no nearer
  float most;   ///< an estimate: it comes as near as that
};

/// Receives a triangle that may be near and returns how near others must be to matter, from now on: metres from the
/// body's surface, never more than before.
using Visit = double (*)(void* context, const Place& place, const Nearness& near);

/// Visits all triangles that may come within `reach` (m) of the body's surface somewhere along the piece, each at
/// least once, roughly nearest first. Grown by the tile's error as above. Absent tiles are looked at likewise. Returns
/// a lower bound of how near the others come, metres from the surface. Of a gap `part` may be given up by
/// Nearness::least, which saves time.
double visit_near(const Index& index, const Piece& piece, double reach, double part, Visit visit, void* context);

/// The same, beginning at such roots; what is within the reach lies in their box too.
double visit_near(const Index& index, std::span<const Root> roots, const Piece& piece, double reach, double part,
                  Visit visit, void* context);

/// The stored triangle as seen from `start`.
[[nodiscard]] certified::LocalTriangle local_triangle(const Index& index, const Place& place, const Vec3& start);

/// How far any source vertex of that tile may lie from the stored one, with all bits that it has (m).
[[nodiscard]] inline double stored_error(const Tile& tile) { return double(tile.fine_error); }

}  // namespace roam::index
