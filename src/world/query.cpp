#include "world/query.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "index/tile_builder.h"
#include "math/floating_point.h"
#include "math/largest.h"
#include "roam/error.h"
#include "text/number.h"
#include "world/scene_queries.h"
#include "world/vicinity.h"

namespace roam {
namespace query {
namespace {

/// Metres. A bound in single precision that is so little below the distance is good enough for a gap: with twice what a
/// tile without low bits is off by, 1.7 mm, it stays within 2 mm.
constexpr float kTight = 2.5e-4F;

/// Metres. The longest motion of one query.
constexpr double kMotionLimit = 1e6;

[[noreturn]] void refuse(const std::string& what) { throw Error("cannot answer a query: " + what); }

[[noreturn]] void refuse_length(double value, double limit, const char* name) {
  refuse(std::string(name) + " is " + number_text(value) + " m; it must be between 0 and " +
         std::to_string(static_cast<long>(limit)) + " m");
}

/// Small enough to be compiled into its callers.
void check_length(double value, double limit, const char* name) {
  if (!(value >= 0.0 && value <= limit)) refuse_length(value, limit, name);
}

/// Whether a body on this piece, grown by `reach`, can meet the box at all. False for everything so far away that the
/// whole steps of the grids would not fit an integer.
bool meets(const Box& box, const index::Piece& piece, double reach) {
  if (box.empty()) return false;
  const double r = piece.body.radius + reach;
  for (int k = 0; k < 3; ++k) {
    const double grown = r + (k == 2 ? piece.body.half_height : 0.0);
    const double a = piece.start[k], b = a + piece.motion[k];
    // Rounding of the sums is far below the metre that is added.
    if (std::max(a, b) + grown + 1.0 < box.lower[k] || std::min(a, b) - grown - 1.0 > box.upper[k]) return false;
  }
  return true;
}

bool nearer(const Contact& a, const Contact& b) {
  return a.distance != b.distance ? a.distance < b.distance : a.triangle < b.triangle;
}

std::span<const index::Root> all_of(const index::Roots& roots) {
  return {roots.root.data(), static_cast<std::size_t>(roots.count)};
}

/// One world, as impact_of and collect_of ask it.
class WorldScene {
 public:
  WorldScene(const WorldData& world, TriangleId base, const index::Roots* roots)
      : world_(world), index_(world.view()), base_(base), roots_(roots) {}

  std::optional<double> first(const index::Piece& piece) {
    if (!meets(world_.reach, piece, 0.0)) return std::nullopt;
    const index::Impact impact =
        roots_ ? index::first_impact(index_, all_of(*roots_), piece) : index::first_impact(index_, piece);
    place_ = impact.place;
    return impact.hit ? std::optional(impact.time) : std::nullopt;
  }
  [[nodiscard]] Contact touched(const index::Piece& at_rest) const {
    return contact_at(index_, at_rest, place_, base_);
  }
  void near(const index::Piece& piece, Collector& collector) const {
    if (!meets(world_.reach, piece, collector.reach())) return;
    if (roots_) {
      visit_near(index_, all_of(*roots_), piece, base_, collector);
    } else {
      visit_near(index_, piece, base_, collector);
    }
  }

 private:
  const WorldData& world_;
  index::Index index_;
  TriangleId base_;
  const index::Roots* roots_;
  index::Place place_;
};

/// Where the body comes nearest to a triangle that is, or is a part of, the stored one at `place`.
Contact contact_with(const certified::LocalTriangle& triangle, const index::Index& index, const index::Piece& piece,
                     const index::Place& place, TriangleId base) {
  const index::Tile& tile = index.tiles[place.tile];
  const index::Leaf& leaf = index.blocks[place.leaf].leaf;
  Contact c;
  static_cast<Proximity&>(c) = piece.motion == Vec3(0.0)
                                   ? certified::proximity(piece.body, triangle)
                                   : certified::approach(piece.body, piece.motion, triangle, 0.0, 1.0).proximity;
  c.point += piece.start;
  c.distance -= index::stored_error(tile);
  c.triangle = base + (index.ids ? index::read_id(index.ids + tile.ids, leaf, static_cast<int>(place.triangle))
                                 : (TriangleId{place.tile} << index::kTileTriangleBits | (leaf.ids + place.triangle)));
  return c;
}

/// What a traversal needs to hand a triangle on to the collector.
struct Visitor {
  const index::Index& index;
  const index::Piece& piece;
  TriangleId base;
  Collector& collector;

  static double visit(void* self, const index::Place& place, const index::Nearness& near) {
    const Visitor& v = *static_cast<Visitor*>(self);
    const index::Tile& tile = v.index.tiles[place.tile];
    if (v.collector.bounds_only()) {
      const auto error = double(tile.error);
      const double least = double(near.least) - v.piece.body.radius - error;
      const double most = double(near.most) - v.piece.body.radius + error;
      const bool tight = !tile.fine && near.most - near.least <= kTight;
      // A loose bound must not tell of what is beyond the reach that was asked for.
      if (tight || (most <= v.collector.asked() && least >= most * (1.0 - gap_part))) {
        Contact bound;
        bound.distance = least;
        v.collector.offer(bound, most - least);
        return v.collector.enough();
      }
    }
    const auto triangle = index::local_triangle(v.index, place, v.piece.start);
    const double doubt = 2.0 * index::stored_error(tile);
    if (const FloorOnly* const floor = v.collector.floor()) {
      for (const auto& part : floor->pieces(triangle)) {
        v.collector.offer(contact_with(part, v.index, v.piece, place, v.base), doubt);
      }
    } else {
      v.collector.offer(contact_with(triangle, v.index, v.piece, place, v.base), doubt);
    }
    return v.collector.enough();
  }
};

}  // namespace

void check(const Body& body, const Vec3& from, const Vec3& motion) {
  check_length(body.radius, World::reach_limit, "the radius");
  check_length(body.half_height, World::reach_limit, "the half height");
  if (!std::isfinite(from.x) || !std::isfinite(from.y) || !std::isfinite(from.z)) refuse("the place is not finite");
  if (!std::isfinite(motion.x) || !std::isfinite(motion.y) || !std::isfinite(motion.z)) {
    refuse("the motion is not finite");
  }
  check_length(largest(motion), kMotionLimit, "the motion's largest component");
}

void check_reach(double reach) { check_length(reach, World::reach_limit, "the reach"); }

void Collector::offer(const Contact& c, double doubt) {
  if (c.distance <= reach_ && !known(c)) {
    if (count_ < out_.size()) {
      out_[count_++] = c;
      std::push_heap(out_.begin(), end(), nearer);
    } else if (nearer(c, out_[0])) {
      std::pop_heap(out_.begin(), end(), nearer);
      out_[count_ - 1] = c;
      std::push_heap(out_.begin(), end(), nearer);
    }
  }
  // What is farther than the farthest of a full list need not be looked at.
  if (count_ == out_.size()) reach_ = std::min(reach_, out_[0].distance);
  enough_ = std::min(enough_, reach_);
  if (tolerance_ > 0.0 && count_ > 0 && c.distance > 0.0) {
    const double told = bounds_only_ ? c.distance + doubt : c.distance;
    enough_ = std::min(enough_, std::max(c.distance + doubt - tolerance_, told * (1.0 - part_)));
  }
}

void Collector::sort() { std::sort_heap(out_.begin(), end(), nearer); }

bool Collector::known(const Contact& c) {
  if (!repeats_) return false;
  const auto same = std::find_if(out_.begin(), end(), [&](const Contact& o) { return o.triangle == c.triangle; });
  if (same == end()) return false;
  if (nearer(c, *same)) {
    *same = c;
    std::make_heap(out_.begin(), end(), nearer);
  }
  return true;
}

Contact contact_at(const index::Index& index, const index::Piece& piece, const index::Place& place, TriangleId base) {
  return contact_with(index::local_triangle(index, place, piece.start), index, piece, place, base);
}

namespace {

/// The part of a gap that may be given up.
double part_of(const Collector& collector) { return collector.bounds_only() ? gap_part : 0.0; }

}  // namespace

void visit_near(const index::Index& index, const index::Piece& piece, TriangleId base, Collector& collector) {
  Visitor visitor{index, piece, base, collector};
  collector.left_out(
      index::visit_near(index, piece, collector.enough(), part_of(collector), &Visitor::visit, &visitor));
}

void visit_near(const index::Index& index, std::span<const index::Root> roots, const index::Piece& piece,
                TriangleId base, Collector& collector) {
  Visitor visitor{index, piece, base, collector};
  collector.left_out(
      index::visit_near(index, roots, piece, collector.enough(), part_of(collector), &Visitor::visit, &visitor));
}

void collect(const WorldData& world, const Way& way, TriangleId base, Collector& collector, const index::Roots* roots) {
  collect_of(WorldScene(world, base, roots), way, collector);
}

Impact first_impact(const WorldData& world, const Way& way, const index::Roots* roots) {
  WorldScene scene(world, 0, roots);
  return impact_of(scene, way);
}

Clearance clearance_of(const Contact* nearest, double reach) {
  Clearance result;
  result.distance = reach;
  if (!nearest) return result;
  static_cast<Proximity&>(result) = *nearest;
  result.found = true;
  result.triangle = nearest->triangle;
  result.unknown = nearest->unknown;
  return result;
}

}  // namespace query

namespace {

/// Where the search in a world begins.
const index::Roots* of_world(Vicinity& vicinity, const WorldData& world, const Body& body, const Vec3& from,
                             const Vec3& motion, double reach) {
  const Question question{body, from, motion, reach, world.stats.largest_error_m, world.revision};
  return roots_in(vicinity, question, [&](const Box& box, index::Roots& out) {
    return world.reach.empty() || index::gather(world.view(), 0, box, out);
  });
}

}  // namespace

Impact World::sweep(const Body& body, const Vec3& from, const Vec3& motion) const {
  const DefaultFloatingPoint guard;
  query::check(body, from, motion);
  return query::first_impact(*data_, {body, from, motion});
}

std::size_t World::contacts(const Body& body, const Vec3& from, const Vec3& motion, double reach,
                            std::span<Contact> contacts) const {
  const DefaultFloatingPoint guard;
  return query::contacts_of(body, from, motion, reach, contacts, [&](const Vec3& way, query::Collector& collector) {
    query::collect(*data_, {body, from, way}, 0, collector);
  });
}

Clearance World::clearance(const Body& body, const Vec3& from, const Vec3& motion, double reach) const {
  const DefaultFloatingPoint guard;
  const double tolerance = query::clearance_tolerance_of(data_->lossless);
  return query::clearance_of(body, from, motion, reach, tolerance, [&](const Vec3& way, query::Collector& collector) {
    query::collect(*data_, {body, from, way}, 0, collector);
  });
}

double World::gap(const Body& body, const Vec3& from, const Vec3& motion, double reach) const {
  const DefaultFloatingPoint guard;
  return query::gap_of(body, from, motion, reach, [&](const Vec3& way, query::Collector& collector) {
    query::collect(*data_, {body, from, way}, 0, collector);
  });
}

Impact World::sweep_in(Vicinity& vicinity, const Body& body, const Vec3& from, const Vec3& motion) const {
  const DefaultFloatingPoint guard;
  query::check(body, from, motion);
  return query::first_impact(*data_, {body, from, motion},
                             of_world(vicinity, *data_, body, from, motion, query::hit_reach));
}

double World::gap_in(Vicinity& vicinity, const Body& body, const Vec3& from, const Vec3& motion, double reach) const {
  const DefaultFloatingPoint guard;
  return query::gap_of(body, from, motion, reach, [&](const Vec3& way, query::Collector& collector) {
    query::collect(*data_, {body, from, way}, 0, collector, of_world(vicinity, *data_, body, from, way, reach));
  });
}

Clearance World::floor_clearance(const Body& body, const Vec3& place, double reach, const Floor& floor) const {
  const DefaultFloatingPoint guard;
  return query::floor_clearance_of(body, place, reach, floor, [&](const Vec3& way, query::Collector& collector) {
    query::collect(*data_, {body, place, way}, 0, collector);
  });
}

}  // namespace roam
