#pragma once
/// \file
/// A step under way: where the body is, how it advances, and the report that is written as it goes.

#include "motion/known.h"
#include "roam/space.h"
#include "roam/step_report.h"
#include "roam/walker_settings.h"
#include "world/nearby.h"

namespace roam::walking {

/// Space::sweep keeps the body this much less than its radius, at most, from every triangle (space.h), metres.
constexpr double world_tolerance = 1e-6;

/// A hit is answered when a triangle is at most this much farther than the radius (space.h), metres.
constexpr double hit_tolerance = 2e-3;

/// Part of the skin within which a body that touches something counts as being at rest there. Moving it back and forth
/// by rounding errors would be seen as jitter.
constexpr double rest_part = 0.125;

/// Part of the wish's length below which what is left of it along the planes is no motion but a standstill.
constexpr double standstill_part = 1e-3;

/// Metres. A way with more gap than this is free without a sweep along it. Half the skin of a lossless world, so that a
/// body at rest beside something has it, and far above what a sweep calls touching.
constexpr double free_gap = 5e-5;

/// The longest way that one sweep is asked for, metres; a space takes 1e6 m.
constexpr double longest_way = 5e5;

/// How a step, or a part of it, ended.
enum class Ending : std::uint8_t {
  done,        ///< all of the time was used
  throttled,   ///< the report is full, or the way too long for one step; Move::time says how far it came
  embedded,    ///< the body does not fit where it is
  bottomless,  ///< it fell below everything
};

/// How far a body gets, and what it then touches.
struct Advance {
  double fraction = 1.0;  ///< of the motion that is certified free, kept a skin away from what it touches
  bool touched = false;   ///< something is in the way of the rest
  bool embedded = false;  ///< it was already at the start: the body does not fit where it is
  Impact contact;         ///< what it touches, when touched
  double gap = 0.0;       ///< metres from its surface to the plane of the contact, at the end of the advance
};

/// What moves, and what it is moved in.
struct Mover {
  const Space& space;
  Vicinity& vicinity;  ///< of the body
  const WalkerSettings& settings;
  StepReport& report;
  double skin;  ///< metres
  double slope_cosine;
  bool was_blocked;  ///< at the end of the step before
};

/// From the first advance on, `known.fit` is not `unproven`.
class Move : public Mover, public Whereabouts {
 public:
  /// A place on the way that undo() returns to.
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

  Move(const Mover& mover, const Whereabouts& from) : Mover(mover), Whereabouts(from), time(mover.report.elapsed) {}

  [[nodiscard]] Body body() const { return Body::capsule(settings.radius, height); }
  [[nodiscard]] double feet() const { return place.z - 0.5 * height; }
  /// The first impact of the body on its way along `motion`.
  [[nodiscard]] Impact sweep(const Vec3& motion) const {
    return Nearby::sweep(space, vicinity, {body(), place, motion});
  }
  /// How far the body gets along `motion`. It stops where the gap to the plane of the contact is `skin`: the skin is
  /// measured along the normal, not along the way, or a grazing body would stop far off and a frontal one near. A body
  /// that is nearer than the skin already does not advance towards that plane; along it and away it does.
  [[nodiscard]] Advance probe(const Vec3& motion) const;

  /// Makes the certified part of `motion`, which takes `seconds` in whole, and adds its segment. Does not note the
  /// contact.
  Advance advance(const Vec3& motion, double seconds);
  /// Certified lower bound of the gap over `motion`, metres, at most as far as clearances are told. Not positive where
  /// the way may not be free.
  [[nodiscard]] double gap_over(const Vec3& motion);
  /// The same of the clearance over a way that a sweep has found free.
  [[nodiscard]] double clearance_over(const Vec3& motion);
  /// The same of a way that no sweep has found free, as from a body to a smaller one that lies in it; 0 where it may
  /// not be.
  [[nodiscard]] double measured(const Vec3& motion);
  /// Measures how free the place is.
  void measure();
  /// Goes along `motion`, part of a way that a sweep has found free, and measures how free that part is.
  void go(const Vec3& motion);
  /// Goes along a way whose certified clearance is given, metres.
  void go(const Vec3& motion, double certified);
  /// Where a touch left less than half the skin, restores it as far as there is room.
  void ease_off(const Advance& touch);
  /// A new height about the same feet or head, and the radius that is set; the caller has seen to it that the body fits
  /// where the one before did. Where the clearance of that one is not known, the new one's is measured.
  void resize(double new_height, const Vec3& new_place);

  void touch(const Impact& contact, double gap);
  /// The body can not go on, because of what it touches at `point`.
  void block(const Vec3& point);
  void note(EventKind kind, const Vec3& point);
  void note(EventKind kind) { note(kind, place); }
  [[nodiscard]] Mark mark() const;
  /// As if nothing had happened since the mark.
  void undo(const Mark& mark);
  /// Whether another part of a step, which may add a handful of segments, still fits into the report.
  [[nodiscard]] bool has_room() const;

 private:
  /// gap_over(), as far as it was looked.
  [[nodiscard]] double look_along(const Vec3& motion);

  Vec3 last_direction_{0.0};
  int merged_ = 0;
};

}  // namespace roam::walking
