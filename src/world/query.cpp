#include "world/query.h"

#include <algorithm>
#include <optional>

#include "index/rest.h"
#include "roam/world.h"
#include "world/remaining.h"
#include "world/scene_queries.h"
#include "world/vicinity.h"

namespace roam {
namespace query {
namespace {

/// Metres. A single-precision bound this close below the distance is good enough for a gap: together with twice the
/// error of a tile without low bits, 1.7 mm, it stays within 2 mm.
constexpr float tight_bound = 2.5e-4F;

/// Metres. Far above the roundings of meets() and the error of any tile.
constexpr double near_slack = 1.0;

/// Whether a body on this piece, grown by `reach`, can meet the box at all. False if it is so far away that the whole
/// steps of the grids would not fit an integer. Inlined, because every sweep makes it.
[[gnu::always_inline]] inline bool meets(const Box& box, const index::Piece& piece, double reach) {
  const double r = piece.body.radius + reach;
  for (int k = 0; k < 3; ++k) {
    const double grown = r + (k == 2 ? piece.body.half_height : 0.0);
    const double a = piece.start[k], b = a + piece.motion[k];
    if (std::max(a, b) + grown < box.lower[k] || std::min(a, b) - grown > box.upper[k]) return false;
  }
  return true;
}

std::span<const index::Root> all_of(const index::Roots& roots) {
  return {roots.root.data(), static_cast<std::size_t>(roots.count)};
}

/// One world as a Scene for first_of and collect_of. `rest`: the index skips triangles.
template <bool rest>
class WorldScene {
 public:
  WorldScene(const WorldData& world, const index::Index& index, TriangleId base, const index::Roots* roots)
      : world_(world), index_(index), base_(base), roots_(roots) {}

  std::optional<double> first(const index::Piece& piece) {
    if (!meets(world_.reach, piece, world_.slack)) return std::nullopt;
    const index::Impact impact = first_in(piece);
    place_ = impact.place;
    return impact.hit ? std::optional(impact.time) : std::nullopt;
  }
  [[nodiscard]] bool name(FirstImpact& first) const {
    first.triangle = number_at(index_, place_);
    first.locator = {place_.tile, place_.leaf, place_.triangle, 0};
    return true;
  }
  [[nodiscard]] Contact touched(const index::Piece& at_rest) const {
    Contact c = contact_at(index_, at_rest, place_);
    c.triangle = number_at(index_, place_);
    return c;
  }
  void near(const index::Piece& piece, Collector& collector) const {
    if (!meets(world_.reach, piece, collector.reach() + near_slack)) return;
    if (roots_) {
      visit_near(index_, all_of(*roots_), piece, base_, collector);
    } else {
      visit_near(index_, piece, base_, collector);
    }
  }

 private:
  [[nodiscard]] index::Impact first_in(const index::Piece& piece) const {
    if constexpr (rest) {
      return roots_ ? index::first_impact_of_rest(index_, all_of(*roots_), piece, 1.0)
                    : index::first_impact_of_rest(index_, piece, 1.0);
    } else {
      return roots_ ? index::first_impact(index_, all_of(*roots_), piece) : index::first_impact(index_, piece);
    }
  }

  const WorldData& world_;
  const index::Index& index_;
  TriangleId base_;
  const index::Roots* roots_;
  index::Place place_;
};

/// The same for the stored triangle at `place`, or a part of it.
Contact contact_with(const certified::LocalTriangle& triangle, const index::Index& index, const index::Piece& piece,
                     const index::Place& place) {
  Contact c = query::contact_with(triangle, piece.body, piece.start, piece.motion);
  c.distance -= index::stored_error(index.tiles[place.tile]);
  return c;
}

/// Passes triangles of a traversal on to the collector.
struct Visitor {
  const index::Index& index;
  const index::Piece& piece;
  TriangleId base;
  Collector& collector;

  void offer(const certified::LocalTriangle& triangle, const index::Place& place, double doubt) const {
    Contact c = contact_with(triangle, index, piece, place);
    c.triangle = base + number_at(index, place);
    collector.offer(c, doubt);
  }

  /// The same without skipped triangles.
  static double visit_rest(void* self, const index::Place& place, const index::Nearness& near) {
    const Visitor& v = *static_cast<Visitor*>(self);
    const index::Skip& skip = *v.index.skip;
    return skip.skips(skip.context, place) ? v.collector.enough() : visit(self, place, near);
  }
  [[nodiscard]] index::Visit visit_one() const { return index.skip == nullptr ? &visit : &visit_rest; }

  static double visit(void* self, const index::Place& place, const index::Nearness& near) {
    const Visitor& v = *static_cast<Visitor*>(self);
    const index::Tile& tile = v.index.tiles[place.tile];
    if (v.collector.bounds_only()) {
      const auto error = double(tile.fine_error);
      const double least = double(near.least) - v.piece.body.radius - error;
      const double most = double(near.most) - v.piece.body.radius + error;
      const bool tight = !tile.fine && near.most - near.least <= tight_bound;
      // A loose bound must not report a triangle beyond the requested reach.
      if (tight || (most <= v.collector.initial_reach() && least >= most * (1.0 - gap_part))) {
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
        v.offer(part, place, doubt);
      }
    } else {
      v.offer(triangle, place, doubt);
    }
    return v.collector.enough();
  }
};

}  // namespace

Contact contact_at(const index::Index& index, const index::Piece& piece, const index::Place& place) {
  return contact_with(index::local_triangle(index, place, piece.start), index, piece, place);
}

namespace {

index::Near near_of(const Collector& collector, const index::Piece& piece) {
  const double reach = collector.enough();
  if (const FloorOnly* const floor = collector.floor()) {
    const auto [lowest, highest] = floor->heights(piece.body.radius + reach);
    return {reach, 0.0, lowest, highest};
  }
  return {reach, collector.bounds_only() ? gap_part : 0.0};
}

}  // namespace

void visit_near(const index::Index& index, const index::Piece& piece, TriangleId base, Collector& collector) {
  Visitor visitor{index, piece, base, collector};
  collector.left_out(index::visit_near(index, piece, near_of(collector, piece), visitor.visit_one(), &visitor));
}

void visit_near(const index::Index& index, std::span<const index::Root> roots, const index::Piece& piece,
                TriangleId base, Collector& collector) {
  Visitor visitor{index, piece, base, collector};
  collector.left_out(index::visit_near(index, roots, piece, near_of(collector, piece), visitor.visit_one(), &visitor));
}

void collect(const WorldData& world, const Query& query, const Part& part, TriangleId base, Collector& collector,
             const index::Roots* roots) {
  if (query.ignored == nullptr) {
    return collect_of(WorldScene<false>(world, world.index, base, roots), query, part, collector);
  }
  const Remaining remaining(world.index, *query.ignored, &world);
  collect_of(WorldScene<true>(world, remaining.index(), base, roots), query, part, collector);
}

void collect_one(const index::Index& index, const Query& query, Collector& collector) {
  const FirstImpact& first = *collector.only();
  Contact c =
      contact_at(index, {query.body, query.from, query.motion}, {first.locator[0], first.locator[1], first.locator[2]});
  c.triangle = first.triangle;
  collector.take_only(c);
}

namespace {

/// Inlined, because every sweep makes it.
template <bool rest>
[[gnu::always_inline]] inline FirstImpact first_impact_in(const WorldData& world, const index::Index& index,
                                                          const Query& query, const Part& part,
                                                          const index::Roots* roots) {
  WorldScene<rest> scene(world, index, 0, roots);
  FirstImpact first = first_of(scene, query, part);
  if (!first.hit) return first;
  first.object = world.object(first.triangle);
  if (first.contact) first.contact->object = first.object;
  return first;
}

[[gnu::noinline]] FirstImpact first_impact_of_rest(const WorldData& world, const Query& query, const Part& part,
                                                   const index::Roots* roots) {
  const Remaining remaining(world.index, *query.ignored, &world);
  return first_impact_in<true>(world, remaining.index(), query, part, roots);
}

}  // namespace

FirstImpact first_impact(const WorldData& world, const Query& query, const Part& part, const index::Roots* roots) {
  if (query.ignored != nullptr) return first_impact_of_rest(world, query, part, roots);
  return first_impact_in<false>(world, world.index, query, part, roots);
}

namespace {

/// The roots where a search in a world begins; null: at the root of the whole index.
const index::Roots* roots_of(const WorldData& world, Vicinity* vicinity, const Query& query, double reach) {
  if (vicinity == nullptr) return nullptr;
  const QueryRegion region{query.body, query.from, query.motion, reach, world.stats.largest_error, world.revision};
  return roots_in(*vicinity, region, [&](const Box& box, index::Roots& out) {
    return world.reach.empty() || index::gather(world.index, 0, box, out);
  });
}

}  // namespace
}  // namespace query

FirstImpact World::find_first(const Query& query, Vicinity* vicinity) const {
  const index::Roots* const roots = query::roots_of(*data_, vicinity, query, query::hit_reach);
  if (query.ignored != nullptr) return query::first_impact_of_rest(*data_, query, {}, roots);
  return query::first_impact_in<false>(*data_, data_->index, query, {}, roots);
}

void World::find_near(const Query& query, Collector& collector, Vicinity* vicinity) const {
  if (collector.only() != nullptr) return query::collect_one(data_->index, query, collector);
  if (data_->lossless) collector.demand(query::lossless_tolerance);
  query::collect(*data_, query, {}, 0, collector, query::roots_of(*data_, vicinity, query, collector.initial_reach()));
  if (collector.bounds_only()) return;
  for (Contact& c : collector.kept()) c.object = data_->object(c.triangle);
}

}  // namespace roam
