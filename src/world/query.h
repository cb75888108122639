#pragma once
/// \file
/// What a query asks of one world, so that one world and many are asked by the same code. Nothing here allocates.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

#include "index/margin.h"
#include "math/largest.h"
#include "world/data.h"
#include "world/floor_only.h"

namespace roam::query {

/// A body's straight way from `from` by `motion` (m); or of that the part between two times, which is all that can
/// concern one of many worlds.
struct Way {
  Body body;
  Vec3 from;
  Vec3 motion;
  double begin = 0.0;  ///< in [0, 1]
  double end = 1.0;    ///< in [begin, 1]
};

/// Throws roam::Error for what is not finite or beyond the limits that space.h names.
void check(const Body& body, const Vec3& from, const Vec3& motion);
void check_reach(double reach);

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

[[nodiscard]] inline double clearance_tolerance_of(bool lossless) {
  return lossless ? lossless_tolerance : clearance_tolerance;
}

/// Keeps the nearest contacts in the caller's memory, as a heap with the farthest on top.
///
/// For a clearance it keeps one, and need not be offered what is hardly nearer (`tolerance`). Be G the true gap, and
/// of each triangle that is offered d its distance, certified and too low by `doubt` at most. Then G <= d + doubt, and
/// whatever comes no nearer than E = d + doubt - tolerance is of no interest: G - tolerance <= E. So enough() is the
/// least E so far, or d where that is less; what has a certified bound beyond it may be left out, if only left_out() is
/// told the bound. certified() is the least of d and of those bounds: none exceeds the true gap, and all are at least
/// the last enough(). As a part of small distances, E gives up less, so that what is near is told exactly, and a sign
/// is never wrong.
///
/// For a gap E is a part (1 - gap_part) of d + doubt. A bound d that is itself no less than that part of d + doubt does
/// as well as an exact one: what is answered is no less than the part of the true gap, whichever bound it comes from.
class Collector {
 public:
  /// `repeats`: the same triangle may be offered twice, by pieces of one motion. Looking for it costs a scan.
  /// `floor`: of triangles only this is to be offered.
  Collector(double reach, std::span<Contact> out, bool repeats, const FloorOnly* floor = nullptr)
      : out_(out), floor_(floor), asked_(reach), reach_(reach), enough_(reach), repeats_(repeats) {}
  /// For a clearance.
  Collector(double reach, Contact& nearest, double tolerance)
      : out_(&nearest, 1),
        floor_(nullptr),
        asked_(reach),
        reach_(reach),
        enough_(reach),
        tolerance_(tolerance),
        part_(least_part),
        repeats_(false) {}
  /// For a gap: of `nearest` only the distance is needed.
  Collector(double reach, Contact& nearest)
      : out_(&nearest, 1),
        floor_(nullptr),
        asked_(reach),
        reach_(reach),
        enough_(reach),
        tolerance_(std::numeric_limits<double>::infinity()),
        part_(gap_part),
        bounds_only_(true),
        repeats_(false) {}

  /// Takes a contact or not. Its distance is certified, and no more than `doubt` (m) less than the true one.
  void offer(const Contact& contact, double doubt = 0.0);
  /// Whether a box of which nothing is known, from which `margin` (m) is kept, counts for a body of this radius.
  [[nodiscard]] bool takes_unknown(const Box& box, double radius, double margin) const {
    return floor_ == nullptr || floor_->may_lie_in(box, radius + reach_, margin);
  }
  /// Something was not offered that comes no nearer than `gap`, which is certified and beyond enough().
  void left_out(double gap) { left_out_ = std::min(left_out_, gap); }
  /// Nearest first.
  void sort();

  /// The reach that it was made for.
  [[nodiscard]] double asked() const { return asked_; }
  /// What comes no nearer can not change the answer.
  [[nodiscard]] double reach() const { return reach_; }
  /// What comes no nearer may be left out, if left_out() is told.
  [[nodiscard]] double enough() const { return enough_; }
  /// Of a clearance that found something: the least gap to anything.
  [[nodiscard]] double certified() const { return std::min(out_[0].distance, left_out_); }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const FloorOnly* floor() const { return floor_; }
  /// Nothing but how far the nearest is will be asked for.
  [[nodiscard]] bool bounds_only() const { return bounds_only_; }

 private:
  [[nodiscard]] std::span<Contact>::iterator end() const { return out_.begin() + static_cast<std::ptrdiff_t>(count_); }
  /// Whether the triangle is in the list; a nearer contact with it replaces that one.
  [[nodiscard]] bool known(const Contact& contact);

  std::span<Contact> out_;
  const FloorOnly* floor_;
  double asked_, reach_, enough_;
  double left_out_ = std::numeric_limits<double>::infinity();
  double tolerance_ = 0.0, part_ = 0.0;
  bool bounds_only_ = false;
  bool repeats_;
  std::size_t count_ = 0;
};

/// Where a body on its way comes nearest to a stored triangle; `distance` holds for the source triangle. Its number is
/// raised by `base`.
[[nodiscard]] Contact contact_at(const index::Index& index, const index::Piece& piece, const index::Place& place,
                                 TriangleId base);

/// Offers the collector every triangle of the index within its reach of the piece, its number raised by `base`.
void visit_near(const index::Index& index, const index::Piece& piece, TriangleId base, Collector& collector);
/// The same, beginning at what was gathered of the index.
void visit_near(const index::Index& index, std::span<const index::Root> roots, const index::Piece& piece,
                TriangleId base, Collector& collector);

/// The first impact with the world on the way; `time` is that of the whole motion. Begins at `roots`, unless that is
/// null; so does the next.
[[nodiscard]] Impact first_impact(const WorldData& world, const Way& way, const index::Roots* roots = nullptr);

/// Offers the collector every triangle within its reach of the way, its number raised by `base`.
void collect(const WorldData& world, const Way& way, TriangleId base, Collector& collector,
             const index::Roots* roots = nullptr);

/// The nearest contact, or none, as a clearance.
[[nodiscard]] Clearance clearance_of(const Contact* nearest, double reach);

/// Space::contacts of whatever collect(motion, collector) offers the collector from: everything within its reach of the
/// body's way along `motion`.
template <class Collect>
std::size_t contacts_of(const Body& body, const Vec3& from, const Vec3& motion, double reach,
                        std::span<Contact> contacts, const Collect& collect) {
  check(body, from, motion);
  check_reach(reach);
  if (contacts.empty()) return 0;
  Collector collector(reach, contacts, largest(motion) > index::kLongestPiece);
  collect(motion, collector);
  collector.sort();
  return collector.count();
}

/// Space::clearance, likewise; `tolerance` is how much less than the true gap it may be, or 0: no less than need be.
template <class Collect>
[[nodiscard]] Clearance clearance_of(const Body& body, const Vec3& from, const Vec3& motion, double reach,
                                     double tolerance, const Collect& collect) {
  check(body, from, motion);
  check_reach(reach);
  Contact nearest;
  Collector collector(reach, nearest, tolerance);
  collect(motion, collector);
  if (collector.count() == 0) return clearance_of(nullptr, reach);
  nearest.distance = collector.certified();
  return clearance_of(&nearest, reach);
}

/// Space::gap, likewise.
template <class Collect>
[[nodiscard]] double gap_of(const Body& body, const Vec3& from, const Vec3& motion, double reach,
                            const Collect& collect) {
  check(body, from, motion);
  check_reach(reach);
  Contact nearest;
  Collector collector(reach, nearest);
  collect(motion, collector);
  return collector.count() > 0 ? collector.certified() : reach;
}

/// Space::floor_clearance, likewise.
template <class Collect>
[[nodiscard]] Clearance floor_clearance_of(const Body& body, const Vec3& place, double reach, const Floor& floor,
                                           const Collect& collect) {
  check(body, place, Vec3(0.0));
  check_reach(reach);
  const FloorOnly only(floor, place);
  Contact nearest;
  Collector collector(reach, {&nearest, 1}, true, &only);
  collect(Vec3(0.0), collector);
  return clearance_of(collector.count() > 0 ? &nearest : nullptr, reach);
}

}  // namespace roam::query
