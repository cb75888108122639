#include <algorithm>
#include <cmath>
#include <string>

#include "index/margin.h"
#include "index/tile_builder.h"
#include "math/largest.h"
#include "roam/error.h"
#include "world/data.h"

namespace roam {
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

void check(const Body& body, const Vec3& from, const Vec3& motion) {
  check_length(body.radius, World::reach_limit, "the radius");
  check_length(body.half_height, World::reach_limit, "the half height");
  if (!std::isfinite(from.x) || !std::isfinite(from.y) || !std::isfinite(from.z)) refuse("the place is not finite");
  if (!std::isfinite(motion.x) || !std::isfinite(motion.y) || !std::isfinite(motion.z)) {
    refuse("the motion is not finite");
  }
  check_length(largest(motion), kMotionLimit, "the motion's largest component");
}

/// The motion cut into pieces that are short enough for the frame of one traversal.
class Pieces {
 public:
  Pieces(const Body& body, const Vec3& from, const Vec3& motion)
      : body_(body),
        from_(from),
        motion_(motion),
        count_(std::max(1, static_cast<int>(std::ceil(largest(motion) / index::kLongestPiece)))) {
    // Starts of later pieces are rounded: three roundings of coordinates no larger than this.
    if (count_ > 1) body_.radius += 0x1p-50 * (largest(from) + largest(motion));
  }

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] index::Piece operator[](int i) const {
    if (count_ == 1) return {body_, from_, motion_};
    return {body_, from_ + motion_ * (double(i) / count_), motion_ / double(count_)};
  }
  /// The time of the whole motion, rounded down.
  [[nodiscard]] double time(int i, double piece_time) const {
    return count_ == 1 ? piece_time : std::max(0.0, (i + piece_time) / count_ * (1.0 - 0x1p-51));
  }

 private:
  Body body_;
  Vec3 from_, motion_;
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

/// Keeps the nearest contacts in the caller's memory, as a heap with the farthest on top.
struct Collector {
  const index::Index& index;
  double reach;
  std::span<Contact> out;
  /// The same triangle may be offered twice, by pieces of one motion. Looking for it costs a scan.
  bool repeats = false;
  const index::Piece* piece = nullptr;
  std::size_t count = 0;

  static double visit(void* self, const index::Place& place) { return static_cast<Collector*>(self)->offer(place); }

  double offer(const index::Place& place) {
    const Contact c = contact_at(index, *piece, place);
    if (c.distance <= reach && !known(c)) {
      if (count < out.size()) {
        out[count++] = c;
        std::push_heap(out.begin(), end(), nearer);
      } else if (nearer(c, out[0])) {
        std::pop_heap(out.begin(), end(), nearer);
        out[count - 1] = c;
        std::push_heap(out.begin(), end(), nearer);
      }
    }
    // What is farther than the farthest of a full list need not be looked at.
    if (count == out.size()) reach = std::min(reach, out[0].distance);
    return reach;
  }

  /// Nearest first.
  void sort() { std::sort_heap(out.begin(), end(), nearer); }

 private:
  [[nodiscard]] std::span<Contact>::iterator end() const { return out.begin() + static_cast<std::ptrdiff_t>(count); }

  /// Whether the triangle is in the list; a nearer contact with it replaces that one.
  bool known(const Contact& c) {
    if (!repeats) return false;
    const auto same = std::find_if(out.begin(), end(), [&](const Contact& o) { return o.triangle == c.triangle; });
    if (same == end()) return false;
    if (nearer(c, *same)) {
      *same = c;
      std::make_heap(out.begin(), end(), nearer);
    }
    return true;
  }
};

/// Offers the collector every triangle within its reach of a piece.
void collect(const Box& bounds, const index::Piece& piece, Collector& collector) {
  if (!meets(bounds, piece, collector.reach)) return;
  collector.piece = &piece;
  visit_near(collector.index, piece, collector.reach, &Collector::visit, &collector);
}

}  // namespace

Impact World::sweep(const Body& body, const Vec3& from, const Vec3& motion) const {
  check(body, from, motion);
  const index::Index index = data_->view();
  const Pieces pieces(body, from, motion);
  Impact result;
  for (int i = 0; i < pieces.count(); ++i) {
    const index::Piece piece = pieces[i];
    if (!meets(data_->reach, piece, 0.0)) continue;
    const index::Impact impact = first_impact(index, piece);
    if (!impact.hit) continue;
    result.hit = true;
    result.time = pieces.time(i, impact.time);
    Contact touched = contact_at(index, {body, from + motion * result.time, Vec3(0.0)}, impact.place);
    if (result.time == 0.0) {  // touching or embedded: name the deepest
      contacts(body, from, Vec3(0.0), std::max(0.0, touched.distance), {&touched, 1});
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

std::size_t World::contacts(const Body& body, const Vec3& from, const Vec3& motion, double reach,
                            std::span<Contact> contacts) const {
  check(body, from, motion);
  check_length(reach, reach_limit, "the reach");
  if (contacts.empty()) return 0;
  const index::Index index = data_->view();
  const Pieces pieces(body, from, motion);
  Collector collector{.index = index, .reach = reach, .out = contacts, .repeats = pieces.count() > 1};
  for (int i = 0; i < pieces.count(); ++i) collect(data_->reach, pieces[i], collector);
  collector.sort();
  return collector.count;
}

Clearance World::clearance(const Body& body, const Vec3& from, const Vec3& motion, double reach) const {
  check(body, from, motion);
  check_length(reach, reach_limit, "the reach");
  const index::Index index = data_->view();
  Contact nearest;
  Clearance result;
  result.distance = reach;
  Collector collector{.index = index, .reach = reach, .out = {&nearest, 1}, .repeats = true};
  const index::Piece start{body, from, Vec3(0.0)};
  // Nearest first at the start: on the way, only what comes nearer still is of interest.
  collect(data_->reach, start, collector);
  if (motion != Vec3(0.0)) {
    const Pieces pieces(body, from, motion);
    for (int i = 0; i < pieces.count(); ++i) collect(data_->reach, pieces[i], collector);
  }
  if (collector.count > 0) {
    static_cast<Proximity&>(result) = nearest;
    result.found = true;
    result.triangle = nearest.triangle;
  }
  return result;
}

}  // namespace roam
