#pragma once
/// \file
/// The support disc that carries a body over cracks: WalkerSettings::support_radius.

#include <optional>

#include "motion/carrying.h"
#include "motion/gait.h"
#include "motion/move.h"

namespace roam::walking {

/// Whether the support disc carries a body with these settings and this height over the plane: there is no floor under
/// its axis at `place`, and no room for a disc of that size to fall. `last`: see find_disc().
[[nodiscard]] Carrying carrying(const Space& space, const WalkerSettings& settings, double skin, double height,
                                const FloorPlane& plane, const Vec3& place, DiscFound& last);

/// Whether the body has a support disc.
[[nodiscard]] bool has_disc(const Move& move);

/// Looks for floor under the axis, at most `reach` metres below the lowest point, and remembers its plane.
/// `horizontal`: metres moved since the last look.
bool see_floor(const Move& move, Gait& gait, double reach, double horizontal);

/// Holds the body where its support disc carries it, if its other ground lies lower than the floor around. `drop` is
/// the distance down to that other ground, metres (negative: higher; infinite: none). Moves down at most `reach`
/// metres. Returns whether the disc carries the body.
bool carry(Move& move, Gait& gait, double drop, double reach);

/// The part of `motion`, in the air, after which the support disc carries the body; nothing if it never does.
[[nodiscard]] std::optional<double> carried_after(const Move& move, Gait& gait, const Vec3& motion);

/// Makes the body stand at the end of carried_after().
void land_on_disc(Move& move, Gait& gait);

/// Called after landing on real ground: forgets the last floor plane if it belongs to another level.
void forget_other_storeys(const Move& move, Gait& gait);

}  // namespace roam::walking
