#pragma once
/// \file
/// Becoming faster and slower within limits.

#include <cmath>

#include "roam/walker_settings.h"

namespace roam::walking {

/// A velocity that becomes another one on the straight way between them, and then stays: first slower, and then faster.
struct Pace {
  Vec3 from{0.0}, slowest{0.0}, to{0.0};  ///< m/s
  double braking = 0.0;                   ///< seconds from `from` to `slowest`
  double gaining = 0.0;                   ///< seconds from there to `to`

  [[nodiscard]] Vec3 velocity(double after) const;  ///< m/s, `after` so many seconds
  [[nodiscard]] Vec3 mean(double over) const;       ///< m/s, on average over so many seconds, > 0
};

/// Whether a wish has limits.
[[nodiscard]] inline bool limits(const WalkerInput& wish) {
  return std::isfinite(wish.acceleration) || std::isfinite(wish.braking);
}

/// The change from a velocity to the wish, within the limits of the wish.
[[nodiscard]] Pace change(const Vec3& from, const WalkerInput& wish);

/// One step on a straight way at whose end the body is to be at rest.
struct Approach {
  double speed = 0.0;    ///< m/s: to wish for in this step
  double seconds = 0.0;  ///< of the step: less than was asked for where it ends at the goal
  double way = 0.0;      ///< metres that free motion brings
};

/// The fastest step that goes no faster than `most` and can still come to rest after `until_rest` metres. `speed`: now,
/// along the way, m/s, >= 0. `goal`: metres, > 0, at most until_rest: where the step ends, should it come so far.
/// `limits`: of acceleration and braking.
[[nodiscard]] Approach approach(double speed, double most, double goal, double until_rest, double seconds,
                                const WalkerInput& limits);

}  // namespace roam::walking
