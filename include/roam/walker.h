#pragma once
/// \file
/// A body that moves through a Space at a person's command and never through a wall.
///
///     roam::Walker walker(space, {.radius = 0.3}, roam::Mode::walk, start);
///     const roam::StepReport& step = walker.step({.velocity = {1.4, 0.0, 0.0}}, 1.0 / 60.0);
///     std::cout << walker.position().x << " is at least " << step.axis_clearance << " m from every wall\n";
///
/// What is promised, for any speed and any time step, in fly and walk mode:
///   - the body only moves along straight pieces that the space has certified free: in this step or, in a space that
///     has a revision, in an earlier one. So at every instant its axis is at least radius - 1e-6 m from every
///     triangle. The report has the segments of the way, each with its own certified bound;
///   - the one exception is a body that is *put* where it does not fit: it is freed by a way that is checked as far as
///     such a way can be (see Walker::place), or held where it is, and the report says which. Segments by which
///     a body was put and not moved are marked as teleports;
///   - the same space, settings and calls give the same bits on every run.
///
/// *Clearance* is the distance, in metres, of the body's axis (a sphere: its centre) from the nearest triangle; the gap
/// between surfaces is clearance - radius. Positions are those of the body's centre. Up is +z.
///
/// A Walker is one body: use it from one thread at a time. A copy is a second body in the same space, as the first one
/// is at that moment: a snapshot to come back to. Any number of them may share a Space. A step allocates nothing. One
/// that was moved from may be assigned to or destroyed, and nothing else. docs/walking.md explains the rules and their
/// limits.

#include <memory>
#include <span>

#include "roam/math.h"
#include "roam/size_region.h"
#include "roam/space.h"
#include "roam/stance.h"
#include "roam/step_report.h"
#include "roam/walker_settings.h"

namespace roam {

class Walker {
 public:
  /// Puts a body into `space`, which must outlive it and stay where it is, at `start` (of its centre), as place() does.
  /// Throws roam::Error for bad settings and for a start that is not finite.
  Walker(const Space& space, const WalkerSettings& settings, Mode mode, const Vec3& start);
  Walker(Space&& space, const WalkerSettings& settings, Mode mode, const Vec3& start) = delete;
  ~Walker();
  Walker(const Walker& other);
  Walker(Walker&& other) noexcept;
  Walker& operator=(const Walker& other);
  Walker& operator=(Walker&& other) noexcept;

  /// Moves for `dt` seconds (>= 0, finite). See the head of this file for what is promised. The report that it returns
  /// is the walker's own, report(): the next call of any kind overwrites it. Throws roam::Error for
  /// a velocity or time that is not finite, and for a limit of acceleration that is not more than 0.
  ///
  /// Cost on free flat ground: one look for the nearest triangle, over the way, and one sweep down to the ground.
  /// Flying: the one look; none at all while the body is still well inside what an earlier one has found free.
  const StepReport& step(const WalkerInput& input, double dt);

  /// Puts the standing body's centre at `centre`, at rest; in walk mode, where only the crouched body fits, that, with
  /// the same feet. Where it does not fit there, it is moved to the nearest place found where it does, at most its own
  /// height away, along a straight way on which a sphere about its centre, as large as the start allows, is certified
  /// to meet nothing: so its centre is never moved to the far side of a wall. Where there is none, in walk mode, it
  /// crouches with its centre there. Else it is held: it stays, every step reports `held`, and only place() and ghost
  /// mode get it away, or a change of the space: when its revision (SpaceFacts) is another, the next step goes on as if
  /// the body had been put there then. A body that is held by what is not known yet also says `met_unknown`; as soon as
  /// it is known there the next step goes on likewise, in spaces without revisions too.
  ///
  /// `centre` is half the height above the feet: a centre on the floor is a body that stands to the waist in it, held
  /// or freed sideways. See place_feet().
  const StepReport& place(const Vec3& centre);
  /// The same for the lowest point of the standing body, metres: `feet` may lie on the floor.
  const StepReport& place_feet(const Vec3& feet);

  /// Changes the mode. Leaving ghost mode inside a wall puts the body to the nearest safe place: the nearest that is
  /// found around it, or the last place of its way as a ghost where it fitted, whichever is nearer. Into walk mode only
  /// places with something below count, where there is one, and so a body that has sunk through the floor comes back
  /// above it.
  const StepReport& set_mode(Mode mode);

  /// From now on the body has another size in these regions, and that of its settings outside all of them. Where
  /// regions overlap, the smallest body and the largest foot count. Copied.
  ///
  /// A body is in a region as soon as its centre or its lowest point is in the bounds, and until both are more than
  /// 5 cm outside. It is asked in each step, every half radius of its way. It becomes smaller at once: the small body
  /// lies in the large one, with the same lowest point and, but for a sphere, the same height. It becomes larger when
  /// the larger body is certified free with the same lowest point, on a slope with one as much higher as the larger
  /// body needs there; until then it goes on as it is. A sphere stays a sphere; the eye keeps its height above the
  /// lowest point, or is at the top of a body that is not so high. A foot that carries stays as large as it is.
  ///
  /// Takes effect with the next call. Throws roam::Error for what check() refuses; then all is as before.
  void set_regions(std::span<const SizeRegion> regions);
  [[nodiscard]] std::span<const SizeRegion> regions() const;

  /// From now on this is the size outside all regions, metres: for those who learn on the way which size serves. A
  /// smaller body is had at once, a larger one as soon as it fits, in this call or a later one; as in regions. Returns
  /// whether the body has the size that is wanted where it is. report() tells what happened. Throws roam::Error for a
  /// size that settings may not have; then all is as before.
  bool resize(double radius, double support_radius);

  [[nodiscard]] const Space& space() const;
  /// As they hold now: radius and support_radius, and of a sphere height, eye and step, are those of the present size.
  [[nodiscard]] const WalkerSettings& settings() const;
  [[nodiscard]] Mode mode() const;
  [[nodiscard]] const Vec3& position() const;  ///< of the centre, metres
  [[nodiscard]] Vec3 feet() const;             ///< the lowest point, metres
  [[nodiscard]] Vec3 eye() const;              ///< the camera, metres
  [[nodiscard]] Body body() const;             ///< as it is now: in size, standing or crouched
  [[nodiscard]] bool crouched() const;
  [[nodiscard]] bool grounded() const;  ///< as stance().grounded()
  [[nodiscard]] const Stance& stance() const;
  /// Cannot move: does not fit where it is and can not be freed, see place(). Or, in walk mode, would fall out of the
  /// scene again, see EventKind::put_back: until there is something below, or in another mode.
  [[nodiscard]] bool held() const;
  /// Upward speed in the air, m/s; 0 on the ground and outside walk mode.
  [[nodiscard]] double rise_speed() const;
  /// Metres per second, on average over the last call: 0 when it did not move the body, and without what it was put. Of
  /// a step: with what move_instances() moved the body before it.
  /// What LiveSpace::update wants to know.
  [[nodiscard]] Vec3 velocity() const;
  /// Metres per second, at the end of the last step, horizontal in walk mode: where the next wish goes on from that has
  /// limits of acceleration, and relative to ground that moves. What the last wish had become by then, along what the
  /// body slid, and 0 where it was stopped, held or put.
  [[nodiscard]] Vec3 pace() const;
  /// What the last call did.
  [[nodiscard]] const StepReport& report() const;

  /// The gap, metres, that the body keeps from what it slides along. Twice the space's largest error, the height of the
  /// bumps that storing a flat wall may make in it, plus 0.1 mm. A soft target: passages that leave less than this on
  /// either side are passed all the same, so that the skin never counts twice.
  [[nodiscard]] double skin() const;

  /// A drop of the lowest point by more than this, metres, below the ground last stood on is a fall: radius + step.
  /// A round body that is carried by the rims of a crack sinks by less than its radius, and ground a step lower still
  /// counts as walked on; what lies deeper can not be climbed out of on foot.
  [[nodiscard]] double fall_limit() const;

  class State;
  /// For the rooms of this library alone.
  [[nodiscard]] const State& state() const { return *state_; }
  [[nodiscard]] State& state() { return *state_; }

 private:
  std::unique_ptr<State> state_;  ///< null when it was moved from
};

}  // namespace roam
