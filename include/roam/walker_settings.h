#pragma once
/// \file
/// What a Walker is told: what its body is and can do, in which mode it moves, and what a person wishes for one step.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include "roam/error.h"
#include "roam/math.h"
#include "roam/size_region.h"
#include "roam/sweep.h"

namespace roam {

/// fly: no gravity, collide and slide. walk: gravity, ground, steps, slopes, crouching. ghost: no collision at all.
enum class Mode : std::uint8_t { fly, walk, ghost };

/// "fly", "walk" or "ghost".
[[nodiscard]] const char* to_string(Mode mode);

/// What the body is and what it can do. The defaults are a grown person on foot.
struct WalkerSettings {
  /// Metres, > 0, <= Space::reach_limit / 4. Half the least width the body needs. Too large: kept out of rooms that a
  /// person enters; too small: falls through cracks that a person steps over.
  double radius = 0.3;
  /// Metres, in [0, Space::reach_limit / 4]. Of a foot that is wider than the body: in walk mode it carries the body
  /// over every crack of the floor in which no disc of this radius finds room, held at the height of the floor. The
  /// foot touches nothing: whatever the body passes, it passes too. Half the width of the widest crack and 2 mm more
  /// will do. Less than `radius` counts as `radius`: over a crack that a body so large cannot fall into it is carried,
  /// and does not sink. What is not known yet carries it as floor does, and the report says `met_unknown`. 0: no foot,
  /// the body stands on its round end. docs/walking.md says what is a crack and what a pit.
  double support_radius = 0.0;
  /// Whole height in metres, >= 2 * radius (equal: the sphere of the paper), <= Space::reach_limit / 4. In every mode:
  /// {.radius = 0.3} flies as a capsule of 1.8 m too; see sphere(). A lower body needs a lower eye, and maybe a lower
  /// step: person() sets them together.
  double height = 1.8;
  /// Camera above the lowest point when standing, metres, in [0, height]. Lowered in proportion when crouched.
  double eye = 1.6;
  /// Metres, in [0, height / 2]. Ground that lies at most this much higher or lower than the ground last stood on is
  /// walked onto without a jump or a fall. 0: every kerb stops the body.
  double step = 0.3;
  /// Degrees, in [0, 89]. Ground steeper than this is a wall to go up and a slide to go down.
  double slope_degrees = 45.0;
  /// Metres per second, > 0, <= 1e4. Only wish_velocity uses it: Walker::step takes any velocity.
  double speed = 1.4;
  /// Factor on speed when hurrying, >= 1.
  double fast_factor = 5.0;
  /// Metres per second squared, >= 0. Walk mode only. 0: a body that leaves the ground floats on.
  double gravity = 9.81;
  /// How high a jump lifts the body, metres, in [0, 100]. 0: it does not jump.
  double jump_height = 0.5;
  /// Whole height when crouched, metres, > 0. Taken as 2 * radius where it is less; a body that is not taller than
  /// that (a sphere never is) does not crouch.
  double crouch_height = 1.1;
  /// How far around the body's surface clearance is measured after each step, metres, in [0, Space::reach_limit].
  /// Reported clearances are capped at radius + clearance_reach. The larger, the slower in wide open scenes.
  double clearance_reach = 1.0;

  /// The standing body: what a space is asked for before there is a Walker, as by Pager::wait.
  [[nodiscard]] Body body() const { return Body::capsule(radius, height); }

  /// A person of another size: the eye a ninth of the height below the top, at 1.6 m of 1.8 m, or at the centre of a
  /// sphere; a step of 0.3 m, or half the height; crouched in proportion too. `height` >= 2 * radius, metres; check()
  /// says where they are out of range.
  static WalkerSettings person(double radius, double height) {
    if (height == 2.0 * radius) return sphere(radius);
    WalkerSettings s;
    const double scale = height / s.height;
    s.radius = radius;
    s.height = height;
    s.eye *= scale;
    s.crouch_height *= scale;
    s.step = std::min(s.step, 0.5 * height);
    return s;
  }

  /// The settings of the paper's sphere: height 2 * radius, the eye at its centre, a step of at most its radius.
  static WalkerSettings sphere(double radius) {
    WalkerSettings s;
    s.radius = radius;
    s.height = 2.0 * radius;
    s.eye = radius;
    s.step = s.step < radius ? s.step : radius;
    return s;
  }
};

/// Throws roam::Error, naming the setting, its value and its range, when a setting is out of range or not a number.
void check(const WalkerSettings& settings);

/// Throws roam::Error, naming the region by its number from 1 and its `why`, for bounds that are empty or not finite,
/// and for a size that a body with these settings may not have: see Walker::set_regions.
void check(std::span<const SizeRegion> regions, const WalkerSettings& settings);

/// The velocity of a person who pushes in `direction` (length at most 1 counts; longer is shortened to 1): m/s.
[[nodiscard]] Vec3 wish_velocity(const WalkerSettings& settings, const Vec3& direction, bool fast);

/// What a person wishes for one step.
struct WalkerInput {
  /// Metres per second, finite. Walk mode takes the horizontal part; in the air it steers as on the ground. On ground
  /// that moves (roam/move_instances.h), and in the air after it, it is relative to that.
  Vec3 velocity{0.0};
  bool jump = false;  ///< walk mode: jump, when on the ground. A level, not an edge: while true, again at each landing
  bool crouch = false;  ///< walk mode: crouch, and stay so. Low ceilings make the body crouch without being told.
  /// Metres per second squared, > 0: how fast the body's velocity, Walker::pace(), becomes the one wished for; infinite:
  /// at once. `braking` holds while the body becomes slower, `acceleration` while it becomes faster. The body goes as far
  /// as that brings it, whatever the time step: from a speed v it stops after v^2 / (2 braking) metres. What it meets,
  /// and a space that makes it wait, stop it at once all the same.
  double acceleration = std::numeric_limits<double>::infinity();
  double braking = std::numeric_limits<double>::infinity();
};

}  // namespace roam
