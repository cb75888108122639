#pragma once
/// \file
/// One stretch of flight: a jump, a fall, a slide down a steep slope.

#include "motion/gait.h"
#include "motion/move.h"

namespace roam::walking {

/// How long a stretch may last, seconds: to the top of a jump, and else so short that chords follow the parabola.
[[nodiscard]] double flight_seconds(const Move& move, const Gait& gait, const Vec3& velocity);

/// Flies for `seconds` with the horizontal `velocity` and gravity, along what is met, until it lands; Move::time tells
/// when. False when the body is embedded.
bool fly_on(Move& move, Gait& gait, const Vec3& velocity, double seconds);

}  // namespace roam::walking
