#pragma once
/// \file
/// The foot that carries a body over cracks: WalkerSettings::support_radius.

#include <optional>

#include "motion/gait.h"
#include "motion/move.h"
#include "roam/support.h"

namespace roam::walking {

/// Whether a body with these settings, and so high now, is carried by its foot over the plane: there is no floor under
/// its axis at `place`, and no room for a disc as large as the foot. `last`: see find_disc().
[[nodiscard]] Carrying carrying(const Space& space, const WalkerSettings& settings, double skin, double height,
                                const FloorPlane& plane, const Vec3& place, DiscFound& last);

/// Whether the body has a foot of its own.
[[nodiscard]] bool has_foot(const Move& move);

/// Looks for floor under the axis, not farther than `reach` metres below the lowest point, and remembers its plane.
/// `horizontal`: metres since it was looked for last.
bool see_floor(const Move& move, Gait& gait, double reach, double horizontal);

/// Holds the body where its foot carries it, when what it stands on else lies `drop` metres lower than it is (negative:
/// higher; infinite: it stands on nothing) and that is lower than the floor around. Not farther than `reach` down.
/// Returns whether it does.
bool carry(Move& move, Gait& gait, double drop, double reach);

/// The part of `motion`, in the air, after which the foot carries the body; nothing when it does not.
[[nodiscard]] std::optional<double> carried_after(const Move& move, Gait& gait, const Vec3& motion);

/// Stands where carried_after() ended.
void land_on_foot(Move& move, Gait& gait);

/// After landing on real ground: the floor that was seen last carries nobody on another level.
void forget_other_storeys(const Move& move, Gait& gait);

}  // namespace roam::walking
