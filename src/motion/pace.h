#pragma once
/// \file
/// Acceleration and braking within limits.

#include <cmath>

#include "roam/walker_settings.h"

namespace roam::walking {

/// A velocity that changes to another one along the straight line between them and then stays: first it brakes, then it
/// accelerates.
struct Pace {
  Vec3 from{0.0}, slowest{0.0}, to{0.0};  ///< m/s
  double braking = 0.0;                   ///< seconds from `from` to `slowest`
  double gaining = 0.0;                   ///< seconds from there to `to`

  [[nodiscard]] Vec3 velocity(double after) const;  ///< m/s, after this many seconds
  [[nodiscard]] Vec3 mean(double over) const;       ///< m/s, mean over this many seconds, > 0
};

/// Whether a wish has limits.
[[nodiscard]] inline bool limits(const WalkerInput& wish) {
  return std::isfinite(wish.acceleration) || std::isfinite(wish.braking);
}

/// The change from a velocity to the wish, within the wish's limits.
[[nodiscard]] Pace change(const Vec3& from, const WalkerInput& wish);

/// One step of a straight way that ends with the body at rest.
struct Approach {
  double speed = 0.0;    ///< m/s: wish for this step
  double seconds = 0.0;  ///< duration of the step: shorter than requested if it ends at the goal
  double way = 0.0;      ///< metres covered by free motion
};

/// The fastest step that is no faster than `most` and can still come to rest after `until_rest` metres. `speed`:
/// present speed along the way, m/s, >= 0. `goal`: metres, > 0, at most until_rest; the step ends there if it comes so
/// far. `limits`: of acceleration and braking.
[[nodiscard]] Approach approach(double speed, double most, double goal, double until_rest, double seconds,
                                const WalkerInput& limits);

}  // namespace roam::walking
