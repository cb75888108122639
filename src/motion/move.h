#pragma once
/// \file
/// A step in progress: the position of the body, its motion, and the report written on the way.

#include <glm/geometric.hpp>

#include "motion/known.h"
#include "roam/space.h"
#include "roam/step_report.h"
#include "roam/walker_settings.h"
#include "world/nearby.h"

namespace roam::walking {

/// Metres. Space::sweep may let the body come this much nearer to a triangle than its radius (space.h).
constexpr double world_tolerance = 1e-6;

/// Metres. A hit may be reported when a triangle is at most this much farther than the radius (space.h).
constexpr double hit_tolerance = 2e-3;

/// Part of the skin. A body that touches something and is off its skin by less than this counts as at rest. Moving it
/// back and forth by rounding errors would be visible as jitter.
constexpr double rest_part = 0.125;

/// Part of the wish's length. If the motion left along the planes is shorter, the body stands still.
constexpr double standstill_part = 1e-3;

/// Metres. A way with more gap than this needs no sweep. It is half the skin of a lossless world, so that a body at
/// rest beside something has this gap; it is also far above the distance at which a sweep reports touching.
constexpr double free_gap = 5e-5;

/// Metres. The longest way passed to one sweep; a space accepts 1e6 m.
constexpr double longest_way = 5e5;

/// The motion, in its direction at least so many metres long. A motion of no length stays as it is.
[[nodiscard]] inline Vec3 at_least(const Vec3& motion, double least) {
  const double length = glm::length(motion);
  return length > 0.0 && length < least ? motion * (least / length) : motion;
}

/// The way a step, or a part of it, ended.
enum class Ending : std::uint8_t {
  done,        ///< all time was used
  throttled,   ///< the report is full, or the way too long for one step; Move::time says how far the step came
  embedded,    ///< the body does not fit at its position
  bottomless,  ///< it fell below everything
};

/// The result of an advance: how far the body gets, and what it then touches.
struct Advance {
  double fraction = 1.0;  ///< certified free part of the motion, up to a skin from the obstacle
  bool touched = false;   ///< an obstacle blocks the rest
  bool embedded = false;  ///< the body already overlaps at the start
  Impact contact;         ///< the contact, if touched
  double gap = 0.0;       ///< metres from the body's surface to the plane of the contact, at the end of the advance
};

/// The moving body's settings, space and report.
struct Mover {
  const Space& space;
  Vicinity& vicinity;  ///< vicinity of the body
  const WalkerSettings& settings;
  StepReport& report;
  double skin;  ///< metres
  double slope_cosine;
  bool was_blocked;  ///< blocked at the end of the step before
};

/// After the first advance `known.fit` is never `unproven`.
class Move : public Mover, public Whereabouts {
 public:
  /// A state that undo() returns to.
  struct Mark {
    Whereabouts at;
    double time;
    Vec3 direction;
    int merged;
    Segment segment;
    std::size_t segments, events;
    InlineList<Contact, 8> contacts;
    bool blocked, met_unknown;
  };

  double time;  ///< seconds since the step began

  // cppcheck-suppress uninitDerivedMemberVar ; the whole Mover is copied
  Move(const Mover& mover, const Whereabouts& from) : Mover(mover), Whereabouts(from), time(mover.report.elapsed) {}

  [[nodiscard]] Body body() const { return Body::capsule(settings.radius, height); }
  [[nodiscard]] double feet() const { return place.z - 0.5 * height; }
  /// The first impact of the body along `motion`.
  [[nodiscard]] Impact sweep(const Vec3& motion) const {
    return Nearby::sweep(space, vicinity, {body(), place, motion});
  }
  /// How far the body gets along `motion`. It stops where its gap to the plane of the contact is `skin`. The skin is
  /// measured along the normal and not along the motion; otherwise a grazing body would stop far off and a frontal one
  /// near. A body already nearer than the skin does not advance towards that plane, but it can move along it and away.
  [[nodiscard]] Advance probe(const Vec3& motion) const;

  /// Makes the certified part of `motion`, whose whole would take `seconds`, and adds its segment. Does not note the
  /// contact.
  Advance advance(const Vec3& motion, double seconds);
  /// Certified lower bound of the gap over `motion`, metres, at most settings.clearance_reach. Not positive if the way
  /// may not be free.
  [[nodiscard]] double gap_over(const Vec3& motion);
  /// The same as a clearance, for a way that a sweep has found free.
  [[nodiscard]] double clearance_over(const Vec3& motion);
  /// The same for a way that no sweep has found free, such as one from a body to a smaller one inside it. 0 if it may
  /// not be free.
  [[nodiscard]] double measured(const Vec3& motion);
  /// Measures the clearance at the position.
  void measure();
  /// Moves along `motion`, part of a way that a sweep has found free, and measures the clearance over that part.
  void go(const Vec3& motion);
  /// Moves along a way whose certified clearance is given, metres.
  void go(const Vec3& motion, double certified);
  /// Restores the skin, as far as there is room, if a touch left less than half of it.
  void ease_off(const Advance& touch);
  /// Sets a new height about the same feet or head, and uses the radius that is set. The caller has made sure that the
  /// new body fits wherever the old one did. If the clearance of the old one is not known, that of the new one is
  /// measured.
  void resize(double new_height, const Vec3& new_place);

  void touch(const Impact& contact, double gap);
  /// The body cannot go on because of what it touches at `point`.
  void block(const Vec3& point);
  void note(EventKind kind, const Vec3& point);
  void note(EventKind kind) { note(kind, place); }
  [[nodiscard]] Mark mark() const;
  /// Restores the state of the mark.
  void undo(const Mark& mark);
  /// Whether the segments of another contact, and what may follow it, still fit into the report. Otherwise the step
  /// ends here, since a segment that is not in the report is checked by nobody.
  [[nodiscard]] bool has_room() const;

 private:
  /// gap_over() as far as the query reached, without the limit of clearance_reach.
  [[nodiscard]] double look_along(const Vec3& motion);
  /// The bound that known.free_way gives for `motion`, or 0 if it gives none that is good enough.
  [[nodiscard]] double known_gap(const Vec3& motion, double reach) const;

  Vec3 last_direction_{0.0};
  int merged_ = 0;
};

}  // namespace roam::walking
