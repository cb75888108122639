#pragma once
/// \file
/// Collision queries: the interface of all that a body moves in (World, Patchwork, Instances, Filtered, Pager).
///
///     const double headroom = 100.0 * space.first_impact({.radius = 0.3}, position, {0.0, 0.0, 100.0}).time;
///
/// sweep() returns the first impact of a motion, contacts() the triangles near it, clearance() its least gap and the
/// nearest triangle. first_impact() and gap_bound() are faster and return fewer facts.
///
/// Lengths are metres. Space is *hit*, *free* or *unknown*. Unknown space is not loaded yet and counts as solid: a
/// query meets its border like a wall and sets `unknown` in the result. For a radius and triangles as the caller passed
/// them, in exact arithmetic:
///   - over [0, time] of a sweep the body's axis is at least radius - 1e-6 m from every triangle. A body that starts
///     nearer gets a hit at time 0;
///   - at the `time` of a hit some triangle is within radius + 2 mm of the axis. A body that starts with a gap below
///     2 mm may get a hit at time 0, even if it moves away: keep 2 * largest_error() from contacts, as Walker does;
///   - a gap_bound() above 0 certifies the first of these for the whole motion.
///
/// Queries are const, never wait and may run at the same time, unless an implementation's header says otherwise. Only
/// batches allocate. Each query throws roam::Error, before it writes a result, for a position or motion that is not
/// finite, a motion beyond Space::motion_limit, and a size or reach that is negative or beyond Space::reach_limit. The
/// host's floating-point environment changes no result and raises no signal: functions that are not inline, with the
/// callbacks and host's spaces that they call, run in the default one and then restore the host's.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "roam/math.h"
#include "roam/sweep.h"

namespace roam {

class Collector;
class Vicinity;

/// Numbers of triangles and objects. A World numbers its meshes, and the triangles of all meshes, in the order passed;
/// the headers of other spaces describe theirs.
using TriangleId = std::uint64_t;
inline constexpr TriangleId no_triangle = ~TriangleId{0};  ///< in a miss, or where nothing was found
using ObjectId = std::uint32_t;
inline constexpr ObjectId no_object = ~ObjectId{0};  ///< in a miss, for unknown space, and for all of a Pager

struct Object {
  ObjectId id = no_object;      ///< no_object: there is no such triangle, or its object has no number
  std::string name;             ///< for display; may be empty
  std::uint64_t user_data = 0;  ///< from Mesh::user_data
};

/// The points p with dot(normal, p) > distance.
struct HalfSpace {
  Vec3 normal{0.0, 0.0, 1.0};  ///< of length 1
  double distance = 0.0;       ///< metres
  [[nodiscard]] bool holds(const Vec3& p) const { return normal.x * p.x + normal.y * p.y + normal.z * p.z > distance; }
  bool operator==(const HalfSpace&) const = default;
};

/// Objects and half spaces that a query ignores. For a moving body use Filtered (roam/filtered.h).
struct ObjectFilter {
  std::span<const ObjectId> objects;       ///< ascending
  const ObjectFilter* also = nullptr;      ///< more of them
  std::span<const HalfSpace> beyond = {};  ///< a triangle with all its corners, as stored, in one of them is ignored
  [[nodiscard]] bool ignores(ObjectId object) const {
    for (const ObjectFilter* f = this; f != nullptr; f = f->also) {
      if (std::binary_search(f->objects.begin(), f->objects.end(), object)) return true;
    }
    return false;
  }
  [[nodiscard]] bool ignores(const Triangle& corners) const {
    for (const ObjectFilter* f = this; f != nullptr; f = f->also) {
      for (const HalfSpace& half : f->beyond) {
        if (half.holds(corners[0]) && half.holds(corners[1]) && half.holds(corners[2])) return true;
      }
    }
    return false;
  }
  /// Whether ignores() of some triangle can be true.
  [[nodiscard]] bool has_beyond() const {
    for (const ObjectFilter* f = this; f != nullptr; f = f->also) {
      if (!f->beyond.empty()) return true;
    }
    return false;
  }
};

/// A body and its straight motion.
struct Query {
  Body body;                              ///< radius and half height in [0, Space::reach_limit]
  Vec3 from{0.0};                         ///< the centre at time 0
  Vec3 motion{0.0};                       ///< the centre at time 1 minus `from`
  const ObjectFilter* ignored = nullptr;  ///< objects to ignore; unknown space is never ignored
};

/// The first impact of a sweep; see SweepResult for the other members. A miss has time 1 and distance 0. Because a
/// space stores triangles to within largest_error(), a hit at time 0 may have a gap of up to 2 mm. `point` lies on the
/// triangle as stored. The normal of a ray is that of the face, or of the nearest edge or corner.
struct Impact : SweepResult {
  TriangleId triangle = no_triangle;  ///< touched first; if `unknown`, Space::object() names the reason
  ObjectId object = no_object;        ///< of the triangle
  bool unknown = false;               ///< the hit is the border of unknown space, or the body starts inside it
};

/// A triangle near a body; see Proximity.
struct Contact : Proximity {
  TriangleId triangle = no_triangle;
  ObjectId object = no_object;
  bool unknown = false;  ///< the contact is the border of unknown space, not a triangle
};

/// The gap between a body and everything: the nearest contact.
struct Clearance : Contact {
  bool found = false;  ///< something lies within the reach; otherwise `distance` is the reach, and the rest default
};

/// The first impact of a sweep without its contact: the members that it shares with Impact have the same values.
struct FirstImpact {
  FirstImpact() noexcept {}  // NOLINT: where this is defaulted, compilers clear all of it
  bool hit = false;
  bool unknown = false;
  double time = 1.0;
  TriangleId triangle = no_triangle;
  ObjectId object = no_object;
  // For authors of spaces: how Space::completed() finds the contact.
  std::array<std::uint32_t, 4> locator{};  ///< the space's own reference to the triangle
  std::optional<Contact> contact;          ///< at `time`, if the space has found it already
  std::uint64_t revision = 0;              ///< of the space; set by Space
};

/// Which triangles count as floor.
struct Floor {
  double slope_degrees = 45.0;  ///< [0, 89]: steepest floor (as stored), either side up; no triangle without area
  double band = std::numeric_limits<double>::infinity();  ///< >= 0: how far above and below the plane floor counts
  Vec3 point{0.0};
  Vec3 normal{0.0, 0.0, 1.0};  ///< of the plane through `point`; any length, z > 0
};

struct SpaceFacts {
  Box bounds = {};             ///< of everything, known or unknown; empty for an empty space
  double largest_error = 0.0;  ///< largest distance of a stored vertex from the caller's; never grows
  /// Changes whenever something came or went. A held body then tries again. While it stays the same, Walker reuses
  /// results of gap_bound(). None: the space may change without notice. Then each step of a body that is held in
  /// something known searches the way out again, which may take 600 queries.
  std::optional<std::uint64_t> revision = {};
  /// m/s: up to this speed, space ahead is loaded in time. Walker slows down to it; a faster body stops at the unknown.
  double speed_limit = std::numeric_limits<double>::infinity();
};

class Space {
 public:
  static constexpr double reach_limit = 1000.0;  ///< largest radius, half height and reach of a query
  static constexpr double motion_limit = 1e6;    ///< largest component of a motion
  virtual ~Space() = default;

  /// First impact of the body on its motion.
  [[nodiscard]] Impact sweep(const Query& query) const { return swept(query, nullptr); }
  /// The same without point and normal; computing these takes a sixth of the time of a sweep that hits.
  [[nodiscard]] FirstImpact first_impact(const Query& query) const;
  /// Completes `first`, from first_impact() for the same query, to the result of sweep(), to the bit. Throws
  /// roam::Error for a hit if the space's revision has changed since; a space without revision must not have changed.
  [[nodiscard]] Impact completed(const Query& query, const FirstImpact& first) const;
  /// The triangles within `reach` of the body's surface, each measured where the motion brings the body closest. Writes
  /// at most contacts.size(), nearest first, ties by triangle, and returns how many: fewer than contacts.size() means
  /// all. The cost for n contacts is n log n, or n^2 for motions over 64 m.
  std::size_t contacts(const Query& query, double reach, std::span<Contact> contacts) const;

  /// The least gap on the motion, within `reach` of the body's surface. `distance` is a certified lower bound, at most
  /// 2 mm too low. Any triangle within 2 mm of the nearest may be named; contacts() names the nearest.
  [[nodiscard]] Clearance clearance(const Query& query, double reach) const;

  /// The clearance of a body at rest from floor alone. With a band, only the part of a triangle inside it is measured:
  /// a capsule as high as the band measures the horizontal distance. Unknown space counts as floor if it reaches into
  /// the band near the body. Also throws roam::Error for a `floor` out of range.
  [[nodiscard]] Clearance floor_clearance(const Body& body, const Vec3& place, double reach, const Floor& floor) const;

  /// A certified lower bound of the least gap on the motion, or `reach` if nothing is within it. A value above 0 means
  /// that the whole motion is free. Below `reach` the value may be too low: the true gap is at most 8/7 of it plus 2
  /// mm. A value <= 0 means touching, overlapping or a gap below 2 mm; it is not a depth.
  [[nodiscard]] double gap_bound(const Query& query, double reach) const { return gap_over(query, reach, nullptr); }

  /// Batches on all cores; they allocate. results[i] is, to the bit, the result of the function above for queries[i];
  /// both spans have one size. An error names the query by its index, and no result is written.
  void sweep(std::span<const Query> queries, std::span<Impact> results) const;
  void clearance(std::span<const Query> queries, double reach, std::span<Clearance> results) const;
  void gap_bound(std::span<const Query> queries, double reach, std::span<double> results) const;

  // The same queries from separate arguments.
  [[nodiscard]] Impact sweep(const Body& body, const Vec3& from, const Vec3& motion) const {
    return sweep(Query{body, from, motion});
  }
  [[nodiscard]] FirstImpact first_impact(const Body& body, const Vec3& from, const Vec3& motion) const {
    return first_impact(Query{body, from, motion});
  }
  std::size_t contacts(const Body& body, const Vec3& from, const Vec3& motion, double reach,
                       std::span<Contact> contacts) const {
    return this->contacts(Query{body, from, motion}, reach, contacts);
  }
  [[nodiscard]] Clearance clearance(const Body& body, const Vec3& from, const Vec3& motion, double reach) const {
    return clearance(Query{body, from, motion}, reach);
  }
  [[nodiscard]] Clearance clearance(const Body& body, const Vec3& place, double reach) const {
    return clearance(Query{body, place}, reach);
  }
  [[nodiscard]] double gap_bound(const Body& body, const Vec3& from, const Vec3& motion, double reach) const {
    return gap_bound(Query{body, from, motion}, reach);
  }

  /// First triangle on the ray from + t * motion, t in [0, 1]: the sweep of a point. It slips through no shared edge.
  [[nodiscard]] Impact ray(const Vec3& from, const Vec3& motion) const { return sweep({0.0, 0.0}, from, motion); }
  /// Whether a sweep from `place` starts free: the certified gap is at least 1e-6 m. A true gap above 2 mm suffices.
  [[nodiscard]] bool fits(const Body& body, const Vec3& place) const {
    constexpr double least_gap = 1e-6;
    return clearance(body, place, least_gap).distance >= least_gap;
  }

  [[nodiscard]] virtual SpaceFacts facts() const = 0;  ///< as of now
  [[nodiscard]] Box bounds() const { return facts().bounds; }
  [[nodiscard]] double largest_error() const { return facts().largest_error; }
  [[nodiscard]] virtual Object object(TriangleId triangle) const = 0;  ///< Object{} for no triangle; allocates
  [[nodiscard]] std::string object_name(TriangleId triangle) const { return object(triangle).name; }

 protected:
  // For authors of spaces: all queries come down to these two functions, which must keep the promises in the head of
  // this file. Queries have been checked and may come from several threads at once. `vicinity` is a cache of this
  // library's own spaces, or null: other spaces ignore it.

  /// The earliest impact, without ignored objects. At time 0 it names the triangle with the most negative distance.
  [[nodiscard]] virtual FirstImpact find_first(const Query& query, Vicinity* vicinity) const = 0;
  /// Offers the collector (roam/collector.h) all that comes within its reach of the body on its motion.
  virtual void find_near(const Query& query, Collector& collector, Vicinity* vicinity) const = 0;

  // For a space around one other, such as Filtered. Pass the vicinity on for the same body and motion, else null. A
  // space of several spaces is Instances or Patchwork: their triangles have numbers of their own.
  [[nodiscard]] static FirstImpact find_first_of(const Space& other, const Query& query, Vicinity* vicinity) {
    return other.find_first(query, vicinity);
  }
  static void find_near_of(const Space& other, const Query& query, Collector& collector, Vicinity* vicinity) {
    other.find_near(query, collector, vicinity);
  }

  Space() = default;
  Space(const Space&) = default;
  Space(Space&&) noexcept = default;
  Space& operator=(const Space&) = default;
  Space& operator=(Space&&) noexcept = default;

 private:
  friend struct Nearby;  // how a Walker queries
  [[nodiscard]] Impact swept(const Query& query, Vicinity* vicinity) const;
  [[nodiscard]] Impact touched(const Query& query, const FirstImpact& first) const;
  [[nodiscard]] double gap_over(const Query& query, double reach, Vicinity* vicinity) const;
};

/// A space that changes, but only in update(). That belongs to the thread that moves the body; no query may run then.
class LiveSpace : public Space {
 public:
  /// Takes changes into use, for `body` at `place` with `velocity` (m/s). Returns whether anything changed. Throws
  /// roam::Error, and changes nothing, for a body or position that no query takes or a velocity that is not finite.
  virtual bool update(const Body& body, const Vec3& place, const Vec3& velocity) = 0;

 protected:
  LiveSpace() = default;
};

}  // namespace roam
