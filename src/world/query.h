#pragma once
/// \file
/// Queries of one world, shared by World and by spaces of many worlds. Nothing here allocates.

#include <span>

#include "index/tile_builder.h"
#include "roam/collector.h"
#include "world/data.h"
#include "world/floor_only.h"

namespace roam::query {

/// The part of a motion between two times, which is all that can concern one of many worlds.
struct Part {
  double begin = 0.0;  ///< in [0, 1]
  double end = 1.0;    ///< in [begin, 1]
};

/// Throws roam::Error if a value is not finite or is beyond the limits in space.h.
void check(const Query& query);
/// Throws roam::Error for what no LiveSpace::update() takes.
void check_update(const Body& body, const Vec3& place, const Vec3& velocity);

/// Metres. A triangle that is hit is at most this near; the search for the deepest contact has the same reach.
inline constexpr double hit_reach = 2e-3;
/// Metres. Space::clearance may return this much less than the true gap, apart from the rounding of the arithmetic.
inline constexpr double clearance_tolerance = 1.99e-3;
/// The same in a lossless world or store.
inline constexpr double lossless_tolerance = 9e-6;

/// Space::clearance may return a distance that is less by this part of it.
inline constexpr double least_part = 1.0 / 16.0;
/// The same for Space::gap_bound, at any distance.
inline constexpr double gap_part = 1.0 / 8.0;

/// The nearest contact of a body during its motion with a triangle in coordinates relative to the start.
[[nodiscard]] inline Contact contact_with(const certified::LocalTriangle& triangle, const Body& body, const Vec3& from,
                                          const Vec3& motion) {
  Contact c;
  static_cast<Proximity&>(c) = motion == Vec3(0.0) ? certified::proximity(body, triangle)
                                                   : certified::approach(body, motion, triangle, 0.0, 1.0).proximity;
  c.point += from;
  return c;
}

/// The same for a stored triangle, without its number; `distance` holds for the source triangle.
[[nodiscard]] Contact contact_at(const index::Index& index, const index::Piece& piece, const index::Place& place);

/// The number of a stored triangle.
[[nodiscard]] inline TriangleId number_at(const index::Index& index, const index::Place& place) {
  const index::Tile& tile = index.tiles[place.tile];
  const index::Leaf& leaf = index.blocks[place.leaf].leaf;
  return index.ids ? index::read_id(index.ids + tile.ids, leaf, static_cast<int>(place.triangle))
                   : (TriangleId{place.tile} << index::tile_triangle_bits | (leaf.ids + place.triangle));
}

/// Offers the collector every triangle of the index within its reach of the piece. `base` is added to the numbers.
void visit_near(const index::Index& index, const index::Piece& piece, TriangleId base, Collector& collector);
/// The same, beginning at gathered roots of the index.
void visit_near(const index::Index& index, std::span<const index::Root> roots, const index::Piece& piece,
                TriangleId base, Collector& collector);

/// The first impact with the world during the motion; `time` refers to the whole motion. Begins at `roots` unless null,
/// as does collect().
[[nodiscard]] FirstImpact first_impact(const WorldData& world, const Query& query, const Part& part = {},
                                       const index::Roots* roots = nullptr);

/// Offers the collector every triangle within its reach of the motion. `base` is added to the numbers.
void collect(const WorldData& world, const Query& query, const Part& part, TriangleId base, Collector& collector,
             const index::Roots* roots = nullptr);

/// Offers the collector the one triangle that it wants.
void collect_one(const index::Index& index, const Query& query, Collector& collector);

}  // namespace roam::query
