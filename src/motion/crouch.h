#pragma once
/// \file
/// Crouching to pass under an obstacle, and standing up again where there is headroom.

#include "motion/move.h"

namespace roam::walking {

/// The height of the crouched body, metres; the standing height if it cannot crouch.
[[nodiscard]] double crouched_height(const WalkerSettings& settings);

/// Crouches on the spot: the feet stay.
void crouch(Move& move);

/// Crouches if that lets the body go on along `motion`, under `contact`, which blocks it.
bool crouch_under(Move& move, const Impact& contact, const Vec3& motion);

/// Stands up if there is headroom for the whole body and its skin, unless only the tall body would be stopped at once
/// along `way`.
void stand_up(Move& move, const Vec3& way);

}  // namespace roam::walking
