#include "world/query.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "index/margin.h"
#include "index/tile_builder.h"
#include "math/largest.h"
#include "roam/error.h"

namespace roam {
namespace query {
namespace {

/// Metres. The longest motion of one query.
constexpr double kMotionLimit = 1e6;

[[noreturn]] void refuse(const std::string& what) { throw Error("cannot answer a query: " + what); }

void check_length(double value, double limit, const char* name) {
  if (!(value >= 0.0 && value <= limit)) {
    refuse(std::string(name) + " is " + std::to_string(value) + " m; it must be between 0 and " +
           std::to_string(static_cast<long>(limit)) + " m");
  }
}

/// The way cut into pieces that are short enough for the frame of one traversal.
class Pieces {
 public:
  explicit Pieces(const Way& way)
      : way_(way),
        span_(way.end - way.begin),
        count_(std::max(1, static_cast<int>(std::ceil(span_ * largest(way.motion) / index::kLongestPiece)))) {
    // Starts of later pieces are rounded: three roundings of coordinates no larger than this. Where the pieces cover
    // only a part of the way, ten.
    const double reach = largest(way.from) + largest(way.motion);
    if (span_ != 1.0) {
      way_.body.radius += 0x1p-48 * reach;
    } else if (count_ > 1) {
      way_.body.radius += 0x1p-50 * reach;
    }
  }

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] index::Piece operator[](int i) const {
    if (count_ == 1 && span_ == 1.0) return {way_.body, way_.from, way_.motion};
    return {way_.body, way_.from + way_.motion * (way_.begin + span_ * (double(i) / count_)),
            way_.motion * span_ / double(count_)};
  }
  /// The time of the whole motion, rounded down.
  [[nodiscard]] double time(int i, double piece_time) const {
    if (span_ != 1.0) return std::max(0.0, (way_.begin + span_ * ((i + piece_time) / count_)) * (1.0 - 0x1p-49));
    return count_ == 1 ? piece_time : std::max(0.0, (i + piece_time) / count_ * (1.0 - 0x1p-51));
  }

 private:
  Way way_;
  double span_;
  int count_;
};

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

TriangleId triangle_id(const index::Index& index, const index::Place& place) {
  const index::Tile& tile = index.tiles[place.tile];
  return index::read_id(index.ids + tile.ids, index.blocks[place.leaf].leaf, static_cast<int>(place.triangle));
}

/// Where a body on its way comes nearest to a stored triangle; `distance` holds for the source triangle.
Contact contact_at(const index::Index& index, const index::Piece& piece, const index::Place& place) {
  const auto triangle = index::local_triangle(index, place, piece.start);
  Contact c;
  static_cast<Proximity&>(c) = piece.motion == Vec3(0.0)
                                   ? certified::proximity(piece.body, triangle)
                                   : certified::approach(piece.body, piece.motion, triangle, 0.0, 1.0).proximity;
  c.point += piece.start;
  c.distance -= index::stored_error(index.tiles[place.tile]);
  c.triangle = triangle_id(index, place);
  return c;
}

bool nearer(const Contact& a, const Contact& b) {
  return a.distance != b.distance ? a.distance < b.distance : a.triangle < b.triangle;
}

/// What a traversal needs to hand a triangle on to the collector.
struct Visitor {
  const index::Index& index;
  const index::Piece& piece;
  TriangleId base;
  Collector& collector;

  static double visit(void* self, const index::Place& place) {
    const Visitor& v = *static_cast<Visitor*>(self);
    Contact c = contact_at(v.index, v.piece, place);
    c.triangle += v.base;
    return v.collector.offer(c);
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

double Collector::offer(const Contact& c) {
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
  return reach_;
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

void collect(const WorldData& world, const Way& way, TriangleId base, Collector& collector) {
  const index::Index index = world.view();
  const Pieces pieces(way);
  for (int i = 0; i < pieces.count(); ++i) {
    const index::Piece piece = pieces[i];
    if (!meets(world.reach, piece, collector.reach())) continue;
    Visitor visitor{index, piece, base, collector};
    visit_near(index, piece, collector.reach(), &Visitor::visit, &visitor);
  }
}

Impact first_impact(const WorldData& world, const Way& way) {
  const index::Index index = world.view();
  const Pieces pieces(way);
  Impact result;
  for (int i = 0; i < pieces.count(); ++i) {
    const index::Piece piece = pieces[i];
    if (!meets(world.reach, piece, 0.0)) continue;
    const index::Impact impact = first_impact(index, piece);
    if (!impact.hit) continue;
    result.hit = true;
    result.time = pieces.time(i, impact.time);
    const Way at_rest{way.body, way.from + way.motion * result.time, Vec3(0.0)};
    Contact touched = contact_at(index, {at_rest.body, at_rest.from, Vec3(0.0)}, impact.place);
    if (result.time == 0.0) {  // touching or embedded: name the deepest
      Collector deepest(std::max(0.0, touched.distance), {&touched, 1}, false);
      collect(world, at_rest, 0, deepest);
    } else {
      touched.distance = std::max(0.0, touched.distance);  // `time` is certified free: only rounding can say less
    }
    result.point = touched.point;
    result.normal = touched.normal;
    result.feature = touched.feature;
    result.triangle = touched.triangle;
    result.distance = touched.distance;
    return result;
  }
  return result;
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

Impact World::sweep(const Body& body, const Vec3& from, const Vec3& motion) const {
  query::check(body, from, motion);
  return query::first_impact(*data_, {body, from, motion});
}

std::size_t World::contacts(const Body& body, const Vec3& from, const Vec3& motion, double reach,
                            std::span<Contact> contacts) const {
  query::check(body, from, motion);
  query::check_reach(reach);
  if (contacts.empty()) return 0;
  query::Collector collector(reach, contacts, largest(motion) > index::kLongestPiece);
  query::collect(*data_, {body, from, motion}, 0, collector);
  collector.sort();
  return collector.count();
}

Clearance World::clearance(const Body& body, const Vec3& from, const Vec3& motion, double reach) const {
  query::check(body, from, motion);
  query::check_reach(reach);
  Contact nearest;
  query::Collector collector(reach, {&nearest, 1}, true);
  // Nearest first at the start: on the way, only what comes nearer still is of interest.
  query::collect(*data_, {body, from, Vec3(0.0)}, 0, collector);
  if (motion != Vec3(0.0)) query::collect(*data_, {body, from, motion}, 0, collector);
  return query::clearance_of(collector.count() > 0 ? &nearest : nullptr, reach);
}

}  // namespace roam
