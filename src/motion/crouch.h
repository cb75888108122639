#pragma once
/// \file
/// Becoming lower to pass under something, and standing up again where there is head-room.

#include "motion/move.h"

namespace roam::walking {

/// The height of the crouched body, metres; the standing height where it can not crouch.
[[nodiscard]] double crouched_height(const WalkerSettings& settings);

/// Crouches on the spot: the feet stay.
void crouch(Move& move);

/// Crouches when that lets the body go on along `motion`, under `contact` that stands in its way.
bool crouch_under(Move& move, const Impact& contact, const Vec3& motion);

/// Stands up when there is head-room for the whole body and its skin.
bool stand_up(Move& move);

}  // namespace roam::walking
