#pragma once
/// \file
/// The interface of all that a body moves in: a World in memory, a Patchwork that grows while one walks in it, a Pager
/// over a store. All of them answer the same questions.
///
///     double headroom(const roam::Space& space, const roam::Vec3& place) {
///       const roam::FirstImpact up = space.first_impact({.radius = 0.3}, place, {0.0, 0.0, 100.0});
///       return 100.0 * up.time;
///     }
///
/// | question | function |
/// |---|---|
/// | what is met first, when and where | sweep(), ray() |
/// | what is met first and when; the place only if it is wanted | first_impact(), completed() |
/// | everything that comes near, nearest first | contacts() |
/// | how near the nearest comes, and which it is | clearance(), floor_clearance() |
/// | how near the nearest comes, in less time | gap() |
/// | whether the body has room | fits() |
/// | what was met | object() |
///
/// Space is *hit*, *free* or *unknown*. Free is only what is certified free: with `radius` and triangles as the caller
/// passed them and distances measured in exact arithmetic,
///   - over [0, time] of a sweep the body's axis is at least radius - 1e-6 m from every triangle. A body that starts
///     nearer is answered a hit at time 0;
///   - a hit is only answered when, at `time`, a triangle is within radius + 2 mm of the axis. A body that
///     starts with a gap of less than 2 mm may be answered a hit at time 0, even when it moves away.
///     Keep a body that is to move on at least 2 * largest_error() from what it touches, as Walker
///     does;
///   - a gap() that is more than 0 certifies the same of its whole way;
///   - what is unknown, because it has not been loaded yet, is solid: it is met like a wall, and the answer says
///     `unknown`.
///
/// Queries are const, never wait, and may run at the same time, unless an implementation's own header says otherwise.
/// All but the batches never allocate. Each throws roam::Error, before it answers anything, for a place or motion that
/// is not finite, a motion beyond Space::motion_limit, and a body or reach that is negative or beyond
/// Space::reach_limit.
///
/// Whatever floating-point environment the host has set (rounding, subnormal numbers, trapped exceptions), the
/// functions of this library that are not inline in a header reckon in the default one and then set the host's again:
/// the answers are the same bits and raise no signal. Callbacks, and spaces of the host's own, run in the default one
/// too.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "roam/error.h"
#include "roam/math.h"
#include "roam/sweep.h"

namespace roam {

class Collector;
class Vicinity;

/// The number of a triangle in a space. A World numbers all meshes' triangles in the order in which they were passed;
/// other spaces say what they number.
using TriangleId = std::uint64_t;
/// The number of no triangle: of a miss, and of what is found nowhere near.
inline constexpr TriangleId no_triangle = ~TriangleId{0};

/// The number of an object in a space. A World numbers its meshes in the order in which they were passed; other spaces
/// say what they number.
using ObjectId = std::uint32_t;
/// The number of no object: of a miss, of what is unknown, and of every hit in a Pager, which has not read the objects.
inline constexpr ObjectId no_object = ~ObjectId{0};

/// What is known of the object that a triangle belongs to.
struct Object {
  ObjectId id = no_object;      ///< no_object: there is no such triangle, or its object is not numbered
  std::string name;             ///< for people; may be empty
  std::uint64_t user_data = 0;  ///< as the program gave it: Mesh::user_data
};

/// Objects that a query passes over. Filtered (roam/filtered.h) is a space without them, for a body that moves.
struct ObjectFilter {
  std::span<const ObjectId> objects;   ///< ascending
  const ObjectFilter* also = nullptr;  ///< more of them

  [[nodiscard]] bool ignores(ObjectId object) const {
    for (const ObjectFilter* f = this; f != nullptr; f = f->also) {
      if (std::binary_search(f->objects.begin(), f->objects.end(), object)) return true;
    }
    return false;
  }
};

/// A body and its straight way.
struct Query {
  Body body;         ///< radius and half height in [0, Space::reach_limit]
  Vec3 from{0.0};    ///< metres: where the centre is at time 0
  Vec3 motion{0.0};  ///< metres, each component at most Space::motion_limit: where the centre is at time 1, less `from`
  /// Objects that are passed over, by the numbers that hits have; null: none. What is unknown is not passed over.
  const ObjectFilter* ignored = nullptr;
};

/// The first impact of a sweep. On a miss `time` is 1, `distance` is 0 (Space::clearance measures how free the way is),
/// and the rest keeps its default. See SweepResult for the other members, with this difference: because a space stores
/// to within largest_error(), a hit at time 0 may be of a body that is up to 2 mm clear. `point` lies on the triangle
/// as stored. The normal of a ray is that of the face, or of the nearest edge or corner.
struct Impact : SweepResult {
  TriangleId triangle = no_triangle;  ///< that is touched first, of a hit; means nothing where `unknown`
  ObjectId object = no_object;        ///< that the triangle belongs to
  bool unknown = false;  ///< of a hit: what is touched is the border of what is not known yet, or the body is in it
};

/// A triangle near a body. See Proximity for the other members.
struct Contact : Proximity {
  TriangleId triangle = no_triangle;
  ObjectId object = no_object;
  bool unknown = false;  ///< no triangle: the border of what is not known yet
};

/// How far a body's surface is from everything. See Proximity for the other members; they are set when `found`.
struct Clearance : Proximity {
  bool found = false;  ///< something lies within the reach that was asked for; else distance is that reach
  TriangleId triangle = no_triangle;  ///< when `found`
  ObjectId object = no_object;        ///< when `found`
  bool unknown = false;               ///< what is nearest is not known yet
};

/// The first impact of a sweep without the place where it touches: what sweep() answers in the members that both have.
struct FirstImpact {
  FirstImpact() noexcept {}  // NOLINT: where this is defaulted, compilers clear all of it

  bool hit = false;
  bool unknown = false;
  double time = 1.0;
  TriangleId triangle = no_triangle;
  ObjectId object = no_object;

  // For authors of spaces: how Space::completed() finds the contact.
  std::array<std::uint32_t, 4> place{};  ///< whatever the space finds the triangle by
  std::optional<Contact> contact;        ///< at `time`, where the space has found it already
  std::uint64_t revision = 0;            ///< of the space when it answered; set by Space
};

/// What counts as floor, and which part of it.
struct Floor {
  /// Degrees, in [0, 89]. A triangle whose plane, as stored, is at most this far from level is floor, whichever side is
  /// up. One without area is not.
  double slope_degrees = 45.0;
  /// Metres, >= 0. Only what of the floor lies at most this much higher or lower than the plane through `point` with
  /// the upward `normal` counts; infinite: all of it.
  double band = std::numeric_limits<double>::infinity();
  Vec3 point{0.0};             ///< metres
  Vec3 normal{0.0, 0.0, 1.0};  ///< of any length; z > 0
};

/// Facts about a whole space.
struct SpaceFacts {
  Box bounds = {};  ///< of all that is there, known or not; empty for an empty space
  /// The farthest that any stored vertex lies from where the caller put it, metres. Does not grow in the life of a
  /// space.
  double largest_error = 0.0;
  /// Another number whenever something came or went. A body that is held then looks for a way out again. While the
  /// number stays the same, Walker reuses earlier answers of gap(). None: the space may change without notice.
  std::optional<std::uint64_t> revision = {};
  /// Metres per second that a body should not exceed now, so that what it comes to is known by then; Walker slows down
  /// to it. Going faster is safe too: the body stops before what is unknown. No limit where everything is known.
  double speed_limit = std::numeric_limits<double>::infinity();
};

class Space {
 public:
  /// Largest radius, half height and contact or clearance reach of a query, in metres.
  static constexpr double reach_limit = 1000.0;
  /// Largest component of a motion, in metres.
  static constexpr double motion_limit = 1e6;

  virtual ~Space() = default;

  /// First impact of the body on its way. Asked again from where it hit, it may answer a hit at time 0 whichever way
  /// the motion leads: see the head of this file.
  [[nodiscard]] Impact sweep(const Query& query) const { return swept(query, nullptr); }
  /// The same without point, normal, feature and distance, which take a sixth of the time of a hit.
  [[nodiscard]] FirstImpact first_impact(const Query& query) const;
  /// Completes the answer `first` of first_impact() to the same query; the result has the bits of sweep(). Throws
  /// roam::Error when the space has changed since.
  [[nodiscard]] Impact completed(const Query& query, const FirstImpact& first) const;

  /// The triangles that come within `reach` (m) of the body's surface somewhere on its way (zero motion: at the place).
  /// Each contact is measured where the body comes closest on its way. Writes at most contacts.size() of them, nearest
  /// first (ties by triangle id), and returns how many it wrote: fewer than contacts.size() means all.
  /// Costs n log n for n contacts; n^2 for motions over 64 m.
  std::size_t contacts(const Query& query, double reach, std::span<Contact> contacts) const;

  /// How near the body comes to anything on its way (zero motion: at the place), looking no farther than `reach` (m)
  /// from its surface. `distance` is a certified lower bound of the gap to every triangle over the whole way, at most
  /// 2 mm less than the true one. If the true gap is more than 2 mm, it is positive. Among triangles whose distances
  /// differ by less than 2 mm, any may be named; contacts() names the nearest.
  [[nodiscard]] Clearance clearance(const Query& query, double reach) const;

  /// The clearance of a body at rest, of floor alone: walls and steep things are passed over. With a band, only the
  /// part of a triangle inside it is measured; a vertical capsule as high as the band measures the horizontal distance.
  /// What is unknown counts as floor where it may hold some: of a band, where the unknown box reaches into it near the
  /// body. The answer says `unknown` then: a caller who must know floor from a guess has to wait. Throws roam::Error
  /// also for a `floor` that is out of range.
  [[nodiscard]] Clearance floor_clearance(const Body& body, const Vec3& place, double reach, const Floor& floor) const;

  /// A certified lower bound of the gap that clearance() measures, metres, for a fraction of its cost: what a moving
  /// body needs at every step. `reach` where nothing comes as near. Where the answer is between 0 and `reach`, the true
  /// gap is at most answer * 8 / 7 + 2 mm. More than 0 only when the whole way is free. A value <= 0 means touching or
  /// overlapping, or a gap of less than 2 mm; it is not a depth, and may be minus the radius where the axis meets
  /// something.
  [[nodiscard]] double gap(const Query& query, double reach) const { return gap_over(query, reach, nullptr); }

  /// Many queries at once, on all cores: answers[i] is what the function above answers to queries[i], to the bit. Both
  /// have one size. Allocates. An error names the query by its index, and then nothing is answered.
  void sweep(std::span<const Query> queries, std::span<Impact> answers) const;
  void clearance(std::span<const Query> queries, double reach, std::span<Clearance> answers) const;
  void gap(std::span<const Query> queries, double reach, std::span<double> answers) const;

  // The same, for a body, a place and a motion that are at hand.
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
  [[nodiscard]] double gap(const Body& body, const Vec3& from, const Vec3& motion, double reach) const {
    return gap(Query{body, from, motion}, reach);
  }

  /// First triangle that the ray from + t * motion, t in [0, 1], meets: the sweep of a point, which slips through no
  /// crack between triangles that share an edge.
  [[nodiscard]] Impact ray(const Vec3& from, const Vec3& motion) const { return sweep({0.0, 0.0}, from, motion); }
  /// Whether the body has room at `place`: a certified gap of a micrometre at least, so that a sweep from there starts
  /// free. What is unknown is no room.
  [[nodiscard]] bool fits(const Body& body, const Vec3& place) const {
    constexpr double least_gap = 1e-6;
    return clearance(body, place, least_gap).distance >= least_gap;
  }

  /// Facts about the whole space, as it is now.
  [[nodiscard]] virtual SpaceFacts facts() const = 0;
  [[nodiscard]] Box bounds() const { return facts().bounds; }
  [[nodiscard]] double largest_error() const { return facts().largest_error; }
  /// The object that a triangle belongs to; Object{} for a number that no triangle here has. Allocates.
  [[nodiscard]] virtual Object object(TriangleId triangle) const = 0;
  [[nodiscard]] std::string object_name(TriangleId triangle) const { return object(triangle).name; }

 protected:
  // For authors of spaces: the two questions that all of the above come down to. That no body passes a wall rests on
  // both. Queries have been checked before they are asked, and may come from several threads at once. `vicinity`, which
  // may be null, is where a body that asks again from nearly the same place keeps what this library's spaces have found
  // around it: other spaces leave it alone.

  /// What is met first: the earliest impact, as the head of this file promises. At time 0 it names the triangle with
  /// the most negative distance. Objects that `query.ignored` ignores are passed over.
  [[nodiscard]] virtual FirstImpact ask_first(const Query& query, Vicinity* vicinity) const = 0;
  /// What comes near: offers the collector (roam/collector.h) all that comes within its reach of the body on its way.
  virtual void ask_near(const Query& query, Collector& collector, Vicinity* vicinity) const = 0;

  // A space that is made of others asks them by these. Pass the vicinity on to one of them at most, with the same body
  // and way, else pass null.
  [[nodiscard]] static FirstImpact ask_first_of(const Space& other, const Query& query, Vicinity* vicinity) {
    return other.ask_first(query, vicinity);
  }
  static void ask_near_of(const Space& other, const Query& query, Collector& collector, Vicinity* vicinity) {
    other.ask_near(query, collector, vicinity);
  }

  Space() = default;
  Space(const Space&) = default;
  Space(Space&&) noexcept = default;
  Space& operator=(const Space&) = default;
  Space& operator=(Space&&) noexcept = default;

 private:
  friend struct Nearby;  // how a Walker asks

  [[nodiscard]] Impact swept(const Query& query, Vicinity* vicinity) const;
  [[nodiscard]] Impact touched(const Query& query, const FirstImpact& first) const;
  [[nodiscard]] double gap_over(const Query& query, double reach, Vicinity* vicinity) const;
};

/// A space that changes between two steps of the body that moves in it. What has come or is to go is taken into use by
/// update() and at no other time; update() belongs to the thread that moves the body, and no query may run during it.
class LiveSpace : public Space {
 public:
  /// `body` at `place` (m) with `velocity` (m/s) is what the space is wanted for. Returns whether anything changed.
  /// Throws roam::Error for a body, place or velocity that no query takes, and then takes nothing.
  virtual bool update(const Body& body, const Vec3& place, const Vec3& velocity) = 0;

 protected:
  LiveSpace() = default;
};

}  // namespace roam
