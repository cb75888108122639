#pragma once
/// \file
/// A walker: a body that walks or flies through a space at a person's command, and never through a wall.
///
///     roam::Walker walker(space, {.radius = 0.3}, roam::Mode::walk, start);
///     const roam::StepReport& step = walker.step({.velocity = {1.4, 0.0, 0.0}}, 1.0 / 60.0);
///     std::cout << walker.position().x << " is at least " << step.axis_clearance << " m from every wall\n";
///
/// Lengths are metres, times seconds, speeds m/s. Positions are those of the body's centre. In fly and walk mode, at
/// any speed and time step, the body moves only along segments that the space has certified free, in this step or, if
/// the space has a revision, in an earlier one. So its axis stays at least radius - 1e-6 m from every triangle. A body
/// that is *put* where it does not fit is the exception: see place(). docs/walking.md has the rules of motion.
///
/// The same space, settings and calls give the same bits. A step allocates nothing. Use a Walker from one thread at a
/// time. Several may share a space; they do not meet each other. A copy is a second body in the same state, such as a
/// snapshot to return to. A moved-from Walker may only be assigned to or destroyed.

#include <memory>
#include <span>

#include "roam/math.h"
#include "roam/space.h"
#include "roam/stance.h"
#include "roam/step_report.h"
#include "roam/walker_settings.h"

namespace roam {

class Walker {
 public:
  /// Puts a body into `space`, which must outlive it and keep its address. Throws roam::Error as check() and place().
  Walker(const Space& space, const WalkerSettings& settings, Mode mode, const Vec3& start);
  Walker(Space&& space, const WalkerSettings& settings, Mode mode, const Vec3& start) = delete;
  ~Walker();
  Walker(const Walker& other);
  Walker(Walker&& other) noexcept;
  Walker& operator=(const Walker& other);
  Walker& operator=(Walker&& other) noexcept;

  /// Moves the body for `dt` seconds. Returns report(), which the next call of any kind overwrites. Throws roam::Error
  /// for a `dt` < 0, a velocity or `dt` not finite, limits of acceleration <= 0, and a ghost beyond coordinate_limit.
  const StepReport& step(const WalkerInput& input, double dt);

  /// Puts the standing body at rest with its centre, half its height above its lowest point, at `centre`. Throws
  /// roam::Error if that is not within coordinate_limit. If the body does not fit there, the first of these that works:
  ///   - in walk mode, it crouches with the same lowest point;
  ///   - it is freed: put to the nearest free position found, at most its height away. Its centre stays on its side of
  ///     walls: a small sphere about the centre meets nothing on the straight line there;
  ///   - in walk mode, it crouches with the same centre;
  ///   - it is held: it stays, and each step reports `held`, until place() or ghost mode. After a change of its size or
  ///     of the space's revision, the next step puts it there again; in a space without revision, each step does
  ///     (see SpaceFacts::revision). In unknown space it also reports `met_unknown`, and is put again once that is
  ///     known, or after such a change.
  const StepReport& place(const Vec3& centre);
  const StepReport& place_feet(const Vec3& feet);  ///< the same for the lowest point, which may lie on the floor

  /// Changes the mode. A body that leaves ghost mode inside a wall is put to the nearest free position found, or the
  /// last one of its way if that is nearer, or held. Into walk mode, positions with something below come first.
  const StepReport& set_mode(Mode mode);

  /// Sets (copies) the regions where the body has another size, from the next call on. Throws roam::Error as check(). A
  /// body enters a region when its centre or lowest point is in the bounds, and leaves it when both are 5 cm outside.
  /// In a fast step it may notice that up to half a radius late. It shrinks at once, keeping its lowest point and,
  /// unless a sphere, its height. It grows as soon as the larger body is certified free with the same lowest point, or
  /// on a slope a little higher. A sphere stays a sphere. The eye keeps its height above the lowest point, or is at the
  /// top of a lower body. A support disc does not shrink while it carries the body.
  void set_regions(std::span<const SizeRegion> regions);
  [[nodiscard]] std::span<const SizeRegion> regions() const;

  /// Sets the size outside all regions. The body shrinks or grows as in regions, in this call or later; see report().
  /// Returns whether it has the size wanted at its position. Throws roam::Error for a size that settings may not have.
  bool resize(double radius, double support_radius);

  [[nodiscard]] const Space& space() const;
  [[nodiscard]] const WalkerSettings& settings() const;  ///< with the present size, see set_regions() and resize()
  [[nodiscard]] Mode mode() const;
  [[nodiscard]] const Vec3& position() const;  ///< of the centre
  [[nodiscard]] Vec3 feet() const;             ///< the lowest point
  [[nodiscard]] Vec3 eye() const;              ///< the camera
  [[nodiscard]] Body body() const;             ///< in its present size, standing or crouched
  [[nodiscard]] bool crouched() const;
  [[nodiscard]] bool grounded() const;  ///< stance().grounded()
  [[nodiscard]] const Stance& stance() const;
  /// Cannot move: cannot be freed (see place()), or would fall out of the scene again, until the mode or space changes.
  [[nodiscard]] bool held() const;
  [[nodiscard]] double rise_speed() const;  ///< in the air, positive upwards; 0 on the ground and outside walk mode
  /// For LiveSpace::update(): the average over the last call, plus that over the move_instances() before it, without
  /// teleports, m/s. It includes the motion of the ground; pace() does not.
  [[nodiscard]] Vec3 velocity() const;
  /// The velocity from which limits of acceleration start: at the end of the last step, along the surface that the body
  /// slid on, relative to moving ground, horizontal in walk mode. 0 if the body was stopped, held or put.
  [[nodiscard]] Vec3 pace() const;
  [[nodiscard]] const StepReport& report() const;  ///< of the last call
  /// The gap kept from surfaces that the body slides along: 2 * largest_error() + 0.1 mm. The body also passes openings
  /// that leave it a smaller gap.
  [[nodiscard]] double skin() const;
  [[nodiscard]] double fall_limit() const;  ///< radius + step: a larger drop below the ground last stood on is a fall

  class State;  // for the rooms of this library alone
  [[nodiscard]] const State& state() const { return *state_; }
  [[nodiscard]] State& state() { return *state_; }

 private:
  std::unique_ptr<State> state_;  ///< null when it was moved from
};

}  // namespace roam
