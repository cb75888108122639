#pragma once
/// \file
/// What a query asks of one world, so that one world and many are asked by the same code. Nothing here allocates.

#include <cstddef>
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

/// Keeps the nearest contacts in the caller's memory, as a heap with the farthest on top.
class Collector {
 public:
  /// `repeats`: the same triangle may be offered twice, by pieces of one motion. Looking for it costs a scan.
  /// `floor`: of triangles only this is to be offered.
  Collector(double reach, std::span<Contact> out, bool repeats, const FloorOnly* floor = nullptr)
      : out_(out), floor_(floor), reach_(reach), repeats_(repeats) {}

  /// Takes a contact or not. Returns how near others must be to matter, from now on.
  double offer(const Contact& contact);
  /// Nearest first.
  void sort();

  [[nodiscard]] double reach() const { return reach_; }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const FloorOnly* floor() const { return floor_; }

 private:
  [[nodiscard]] std::span<Contact>::iterator end() const { return out_.begin() + static_cast<std::ptrdiff_t>(count_); }
  /// Whether the triangle is in the list; a nearer contact with it replaces that one.
  [[nodiscard]] bool known(const Contact& contact);

  std::span<Contact> out_;
  const FloorOnly* floor_;
  double reach_;
  bool repeats_;
  std::size_t count_ = 0;
};

/// Where a body on its way comes nearest to a stored triangle; `distance` holds for the source triangle. Its number is
/// raised by `base`.
[[nodiscard]] Contact contact_at(const index::Index& index, const index::Piece& piece, const index::Place& place,
                                 TriangleId base);

/// Offers the collector every triangle of the index within its reach of the piece, its number raised by `base`.
void visit_near(const index::Index& index, const index::Piece& piece, TriangleId base, Collector& collector);

/// The first impact with the world on the way; `time` is that of the whole motion.
[[nodiscard]] Impact first_impact(const WorldData& world, const Way& way);

/// Offers the collector every triangle within its reach of the way, its number raised by `base`.
void collect(const WorldData& world, const Way& way, TriangleId base, Collector& collector);

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

/// Space::clearance, likewise.
template <class Collect>
[[nodiscard]] Clearance clearance_of(const Body& body, const Vec3& from, const Vec3& motion, double reach,
                                     const Collect& collect) {
  check(body, from, motion);
  check_reach(reach);
  Contact nearest;
  Collector collector(reach, {&nearest, 1}, true);
  // Nearest first at the start: on the way, only what comes nearer still is of interest.
  collect(Vec3(0.0), collector);
  if (motion != Vec3(0.0)) collect(motion, collector);
  return clearance_of(collector.count() > 0 ? &nearest : nullptr, reach);
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
