#pragma once
/// \file
/// What a query asks of one world, so that one world and many are asked by the same code. Nothing here allocates.

#include <cstddef>
#include <span>

#include "index/tile_builder.h"
#include "roam/collector.h"
#include "world/data.h"
#include "world/floor_only.h"

namespace roam::query {

/// The part of a way between two times, which is all that can concern one of many worlds.
struct Part {
  double begin = 0.0;  ///< in [0, 1]
  double end = 1.0;    ///< in [begin, 1]
};

/// Throws roam::Error for what is not finite or beyond the limits that space.h names.
void check(const Query& query);

/// Metres. A hit is of something that is this near at most, and so is what is looked for to name the deepest.
inline constexpr double hit_reach = 2e-3;
/// Metres. How much less than the true gap Space::clearance may answer, the rounding of the arithmetic apart.
inline constexpr double clearance_tolerance = 1.99e-3;
/// The same in a lossless world or store.
inline constexpr double lossless_tolerance = 9e-6;

/// Of a clearance: how much less than the distance that was found may be answered at most.
inline constexpr double least_part = 1.0 / 16.0;
/// The same of Space::gap, whatever the distance.
inline constexpr double gap_part = 1.0 / 8.0;

/// Where the body comes nearest to a triangle that is seen from where it starts.
[[nodiscard]] inline Contact contact_with(const certified::LocalTriangle& triangle, const Body& body, const Vec3& from,
                                          const Vec3& motion) {
  Contact c;
  static_cast<Proximity&>(c) = motion == Vec3(0.0) ? certified::proximity(body, triangle)
                                                   : certified::approach(body, motion, triangle, 0.0, 1.0).proximity;
  c.point += from;
  return c;
}

/// The same of a stored triangle, whose number is left out; `distance` holds for the source triangle.
[[nodiscard]] Contact contact_at(const index::Index& index, const index::Piece& piece, const index::Place& place);

/// The number of a stored triangle.
[[nodiscard]] inline TriangleId number_at(const index::Index& index, const index::Place& place) {
  const index::Tile& tile = index.tiles[place.tile];
  const index::Leaf& leaf = index.blocks[place.leaf].leaf;
  return index.ids ? index::read_id(index.ids + tile.ids, leaf, static_cast<int>(place.triangle))
                   : (TriangleId{place.tile} << index::tile_triangle_bits | (leaf.ids + place.triangle));
}

/// Offers the collector every triangle of the index within its reach of the piece, its number raised by `base`.
void visit_near(const index::Index& index, const index::Piece& piece, TriangleId base, Collector& collector);
/// The same, beginning at what was gathered of the index.
void visit_near(const index::Index& index, std::span<const index::Root> roots, const index::Piece& piece,
                TriangleId base, Collector& collector);

/// The first impact with the world on the way; `time` is that of the whole motion. Begins at `roots`, unless that is
/// null; so does the next.
[[nodiscard]] FirstImpact first_impact(const WorldData& world, const Query& query, const Part& part = {},
                                       const index::Roots* roots = nullptr);

/// Offers the collector every triangle within its reach of the way, its number raised by `base`.
void collect(const WorldData& world, const Query& query, const Part& part, TriangleId base, Collector& collector,
             const index::Roots* roots = nullptr);

/// Offers the collector the one triangle that it wants.
void collect_one(const index::Index& index, const Query& query, Collector& collector);

}  // namespace roam::query
