#pragma once
/// \file
/// What a body moves in, whoever holds it: a World in memory, a Patchwork that grows while one walks in it, a scene
/// graph that is asked as it is.
///
///     double headroom(const roam::Space& space, const roam::Vec3& place) {
///       const roam::Impact up = space.sweep({.radius = 0.3}, place, {0.0, 0.0, 100.0});
///       return up.hit ? 100.0 * up.time : 100.0;
///     }
///
/// Space is *hit*, *free* or *unknown*. Free is only what is certified free: with `radius` and triangles as the caller
/// passed them and distances measured in exact arithmetic,
///   - over [0, time] of a sweep the body's axis is at least radius - 1e-6 m from every triangle, unless it starts
///     nearer: then it is a hit at time 0;
///   - a hit is only answered when, at `time`, a triangle is within radius + 2 mm of the axis. So a body that starts
///     less than that from a wall may be answered a hit at time 0, whichever way it moves: keep a body that is to move
///     on at least 2 * largest_error() from what it touches, as Walker does;
///   - a gap() that is more than 0 certifies the same of its whole way;
///   - what is unknown, because it has not been loaded yet, is solid: it is met like a wall, and the answer says
///     `unknown`.
///
/// Whatever floating-point environment the host has set (rounding, subnormal numbers, trapped exceptions), the
/// functions of this library that are not inline in a header reckon in the default one and then set the host's again:
/// the answers are the same bits and raise no signal. Callbacks, and spaces of the host's own, run in the default one
/// too.
///
/// Queries are const, never allocate, never wait, and may run at the same time, unless an implementation's own header
/// says otherwise. They throw roam::Error for non-finite input and for bodies or distances beyond Space::reach_limit.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "roam/error.h"
#include "roam/math.h"
#include "roam/sweep.h"
#include "roam/vicinity.h"

namespace roam {

/// The number of a triangle in a space. A World numbers all meshes' triangles in the order in which they were passed;
/// other spaces say what they number.
using TriangleId = std::uint64_t;
/// The number of no triangle: of a miss, and of what is found nowhere near.
inline constexpr TriangleId no_triangle = ~TriangleId{0};

/// The first impact of a sweep, or none (`hit` is false: then `distance` is 0, for Space::clearance says how free the
/// way is, and the rest is as it was made). See SweepResult for the other members, with this difference: because a
/// space stores to within largest_error(), a hit at time 0 may be of a body that is up to 2 mm clear. `point` lies on
/// the triangle as stored. The normal of a ray is that of the face, or of the nearest edge or corner.
struct Impact : SweepResult {
  TriangleId triangle = no_triangle;  ///< that is touched first, of a hit; means nothing where `unknown`
  bool unknown = false;  ///< of a hit: what is touched is the border of what is not known yet, or the body is in it
};

/// A triangle near a body. See Proximity for the other members.
struct Contact : Proximity {
  TriangleId triangle = no_triangle;
  bool unknown = false;  ///< no triangle: the border of what is not known yet
};

/// How far a body's surface is from everything. See Proximity for the other members; they are set when `found`.
struct Clearance : Proximity {
  bool found = false;  ///< something lies within the reach that was asked for; else distance is that reach
  TriangleId triangle = no_triangle;  ///< when `found`
  bool unknown = false;               ///< what is nearest is not known yet
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

class Space {
 public:
  /// Largest radius, half height and contact or clearance reach of a query, in metres.
  static constexpr double reach_limit = 1000.0;
  /// Largest absolute coordinate of a vertex, in metres.
  static constexpr double coordinate_limit = 1e9;

  virtual ~Space() = default;

  /// First impact of `body`, its centre moved from `from` by `motion` (metres, up to 1e6 m). Asked again from where it
  /// hit, it may answer a hit at time 0 whichever way `motion` leads: see the head of this file.
  [[nodiscard]] virtual Impact sweep(const Body& body, const Vec3& from, const Vec3& motion) const = 0;

  /// The triangles that come within `reach` (m) of the body's surface somewhere along the motion (zero motion: at
  /// the place). Each contact is measured where the body comes closest on its way. Writes at most contacts.size() of
  /// them, nearest first (ties by triangle id), and returns how many it wrote: fewer than contacts.size() means all.
  /// Costs n log n for n contacts; n^2 for motions over 64 m.
  virtual std::size_t contacts(const Body& body, const Vec3& from, const Vec3& motion, double reach,
                               std::span<Contact> contacts) const = 0;

  /// How near `body` comes to anything on its way along `motion` (zero motion: at the place), looking no farther than
  /// `reach` (m) from its surface. `distance` is a certified lower bound of the gap to every triangle over the whole
  /// way, at most 2 mm less than the true one; of a gap that is larger than that it has the sign. The triangle that is
  /// named, and where it is touched, may be of another that comes as near to within 2 mm, as among the thousands of a
  /// fine wall: contacts() tells which is the nearest.
  [[nodiscard]] virtual Clearance clearance(const Body& body, const Vec3& from, const Vec3& motion,
                                            double reach) const = 0;
  /// The same for a body at rest.
  [[nodiscard]] Clearance clearance(const Body& body, const Vec3& place, double reach) const {
    return clearance(body, place, Vec3(0.0), reach);
  }

  /// The same where nothing but floor is there to be met: walls and steep things are passed over. With a band, parts of
  /// triangles are measured, and a vertical capsule that is as high as the band answers how far the floor is seen from
  /// above. What is unknown counts as floor where it may hold some: of a band, where the box that is not known reaches
  /// into it near the body. The answer says `unknown` then: a caller who must know floor from a guess has to wait.
  /// Throws roam::Error also for a `floor` that is out of range.
  [[nodiscard]] virtual Clearance floor_clearance(const Body& body, const Vec3& place, double reach,
                                                  const Floor& floor) const = 0;
  [[nodiscard]] Clearance floor_clearance(const Body& body, const Vec3& place, double reach,
                                          double slope_degrees) const {
    Floor floor;
    floor.slope_degrees = slope_degrees;
    return floor_clearance(body, place, reach, floor);
  }

  /// Whether the body has room at `place`: a certified gap of a micrometre at least, so that a sweep from there starts
  /// free. What is unknown is no room.
  [[nodiscard]] bool fits(const Body& body, const Vec3& place) const {
    constexpr double least_gap = 1e-6;
    return clearance(body, place, least_gap).distance >= least_gap;
  }

  /// What a moving body needs to know at every step, for a fraction of the cost of clearance(): of the same gap a
  /// certified lower bound alone, metres, at most `reach`, and `reach` where nothing comes as near. Where the answer is
  /// between 0 and `reach`, the true gap is at most answer * 8 / 7 + 2 mm. More than 0 only when the whole way is free.
  /// Of what is not positive only the sign counts: where the axis meets something it may be minus the radius, no depth.
  /// For authors of spaces: Walker makes no sweep along a way of which this, or gap_in(), exceeds 0.05 mm. That the
  /// body passes nothing rests on it then as it does on sweep().
  [[nodiscard]] virtual double gap(const Body& body, const Vec3& from, const Vec3& motion, double reach) const {
    return clearance(body, from, motion, reach).distance;
  }

  /// sweep() and gap() of a body that asks again from near where it asked last and keeps what lies around it: the same
  /// promises, and in a World or a Pager less to look at. Within what they leave open an answer may be another, for it
  /// depends on where a search begins: a hit by the 0.025 mm by which a body may arrive before it touches, along a
  /// flat way by more, a gap by the part that it may be told too small. The same questions in the same order, from an
  /// equal vicinity on and while revision() is the same, get the same bits.
  ///
  /// For authors of spaces: Walker asks these. Who wraps a space passes them on too, or, where it answers sweep() and
  /// gap() otherwise than the space within does, overrides neither.
  [[nodiscard]] virtual Impact sweep_in([[maybe_unused]] Vicinity& vicinity, const Body& body, const Vec3& from,
                                        const Vec3& motion) const {
    return sweep(body, from, motion);
  }
  [[nodiscard]] virtual double gap_in([[maybe_unused]] Vicinity& vicinity, const Body& body, const Vec3& from,
                                      const Vec3& motion, double reach) const {
    return gap(body, from, motion, reach);
  }

  /// First triangle that the ray from + t * motion, t in [0, 1], meets: the sweep of a point, which slips through no
  /// crack between triangles that share an edge.
  [[nodiscard]] Impact ray(const Vec3& from, const Vec3& motion) const { return sweep({0.0, 0.0}, from, motion); }

  /// The box of all that is there, known or not; empty for an empty space.
  [[nodiscard]] virtual Box bounds() const = 0;
  /// The farthest that any stored vertex lies from where the caller put it, metres. Does not grow in the life of a
  /// space.
  [[nodiscard]] virtual double largest_error() const = 0;
  /// The name of the object that a triangle belongs to; may be empty, and is for a number that no triangle here has.
  [[nodiscard]] virtual std::string object_name(TriangleId triangle) const = 0;
  /// Becomes another number whenever something came or went: a body that is held then looks for a way out again. Stays
  /// what it is in a space that never changes, and in one that does not know.
  [[nodiscard]] virtual std::uint64_t revision() const { return 0; }
  /// Whether revision() tells of every change, so that what was answered once is answered again while it stays.
  ///
  /// For authors of spaces: where this is true, Walker remembers what gap() found free, and goes there without asking
  /// while revision() is the same. A change that is not told lets it walk into what came.
  [[nodiscard]] virtual bool tells_changes() const { return false; }
  /// Metres per second that a body should not exceed now, so that what it comes to is known by then; Walker slows down
  /// to it. Going faster is safe too: the body stops before what is unknown. No limit where everything is known.
  [[nodiscard]] virtual double speed_limit() const { return std::numeric_limits<double>::infinity(); }

 protected:
  Space() = default;
  Space(const Space&) = default;
  Space(Space&&) noexcept = default;
  Space& operator=(const Space&) = default;
  Space& operator=(Space&&) noexcept = default;
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
