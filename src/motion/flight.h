#pragma once
/// \file
/// Flight over a short time: a jump, a fall, a slide down a steep slope.

#include "motion/gait.h"
#include "motion/move.h"

namespace roam::walking {

/// Greatest duration of one flight, seconds: to the top of a jump, or else so short that chords follow the parabola.
[[nodiscard]] double flight_seconds(const Move& move, const Gait& gait, const Vec3& velocity);

/// Flies for `seconds` with the horizontal `velocity` and gravity, sliding along obstacles, until the body lands;
/// Move::time is then the time of landing. False if the body is embedded.
bool fly_on(Move& move, Gait& gait, const Vec3& velocity, double seconds);

}  // namespace roam::walking
