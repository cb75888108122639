#pragma once
/// \file
/// Settings and input of a Walker: the body, what it can do, its size by region, and the wish for one step.

#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "roam/math.h"
#include "roam/sweep.h"

namespace roam {

/// fly: no gravity, collide and slide. walk: gravity, ground, steps, slopes, crouching. ghost: no collision.
enum class Mode : std::uint8_t { fly, walk, ghost };
[[nodiscard]] const char* to_string(Mode mode);  ///< "fly", "walk" or "ghost"

/// The body and what it can do; the defaults are an adult on foot. Lengths are metres, angles degrees. The height is at
/// most Space::reach_limit / 4 = 250, the radius at most 125.
struct WalkerSettings {
  double radius = 0.3;  ///< >= 0.001. Too large a body is kept out of rooms; too small a body falls into cracks
  /// >= 0: radius of the support disc, in walk mode; 0: none. The disc carries the body, at the height of the floor,
  /// over each crack that has no room for the disc. Its radius must exceed half the width of the widest crack by 2 mm.
  /// Walls do not stop it. A value between 0 and `radius` counts as `radius`. Unknown space carries it as floor does;
  /// the report says `met_unknown`. docs/walking.md defines cracks and pits.
  double support_radius = 0.0;
  /// >= 2 * radius (equal: a sphere), in every mode: {.radius = 0.3} also flies as a capsule of 1.8 m. A lower body
  /// needs a lower eye and perhaps a lower step: see person() and sphere().
  double height = 1.8;
  double eye = 1.6;              ///< [0, height]: camera above the lowest point, lowered in proportion when crouched
  double step = 0.3;             ///< [0, height / 2]: the body walks up and down steps so high; 0: kerbs stop it
  double slope_degrees = 45.0;   ///< [0, 89]: steeper ground is a wall to go up and a slide to go down
  double speed = 1.4;            ///< m/s, (0, 1e4], for wish_velocity() alone: Walker::step() takes any velocity
  double fast_factor = 5.0;      ///< [1, 1e3]: factor on speed when hurrying
  double gravity = 9.81;         ///< m/s^2, [0, 1e3], in walk mode. 0: a body that leaves the ground floats on
  double jump_height = 0.5;      ///< [0, 100]. 0: the body does not jump
  double crouch_height = 1.1;    ///< > 0; 2 * radius if that is more. A body that is no taller does not crouch
  double clearance_reach = 1.0;  ///< [0, Space::reach_limit]: caps reported gaps; larger is slower in the open

  [[nodiscard]] Body body() const { return Body::capsule(radius, height); }  ///< the standing body

  /// Another size: eye and crouch height in proportion, step at most height / 2. sphere() if height is 2 * radius.
  static WalkerSettings person(double radius, double height);
  /// A sphere, as in the paper: the eye at its centre, a step of at most its radius.
  static WalkerSettings sphere(double radius);
};

/// A region of a scene with its own size of the body, for Walker::set_regions(). If regions overlap, the smallest body
/// and the largest support disc apply.
struct SizeRegion {
  Box bounds = {};              ///< finite, not empty
  double radius = 0.0;          ///< of the body, >= 0.001; a capsule keeps its height
  double support_radius = 0.0;  ///< of the support disc, see WalkerSettings::support_radius; 0: no disc in here
  std::string why = {};         ///< for display: "door 0.71 m wide"
};

/// Throws roam::Error, naming the setting, its value and its range, if a setting is out of range or NaN.
void check(const WalkerSettings& settings);
/// Throws roam::Error, naming the region by its number from 1 and its `why`, for bounds that are empty or not finite,
/// and for a size that these settings may not have.
void check(std::span<const SizeRegion> regions, const WalkerSettings& settings);

/// The velocity, m/s, of a push in `direction`, whose length counts up to 1. Throws roam::Error if it is not finite.
[[nodiscard]] Vec3 wish_velocity(const WalkerSettings& settings, const Vec3& direction, bool fast);

/// The wish for one step.
struct WalkerInput {
  /// m/s, finite. In walk mode only the horizontal part counts, also in the air. On moving ground, and in the air after
  /// leaving it, it is relative to that ground (roam/move_instances.h).
  Vec3 velocity{0.0};
  bool jump = false;    ///< walk mode: jump when on the ground; while true, again at each landing
  bool crouch = false;  ///< walk mode: crouch and stay so; under low ceilings the body crouches by itself
  /// m/s^2, > 0: how fast Walker::pace() approaches `velocity`. From v the body stops after v^2 / (2 braking) metres,
  /// whatever the time step. Contacts and a slow space still stop it at once.
  double acceleration = std::numeric_limits<double>::infinity();
  double braking = std::numeric_limits<double>::infinity();
};

}  // namespace roam
