#pragma once
/// \file
/// Ways out for a body that does not fit at its position.

#include <optional>

#include "roam/space.h"

namespace roam::walking {

/// Whether a body that falls from `place` lands on something, known or unknown.
[[nodiscard]] bool above_ground(const Space& space, const Body& body, const Vec3& place);

/// `checked` allows only ways along which a sphere about the body's centre meets nothing, so that the centre stays on
/// its side of every wall. The sphere's radius is nine tenths of the centre's distance from everything. A body whose
/// centre lies on a triangle has no such way. `any` also allows ways through walls.
enum class Way : std::uint8_t { checked, any };
/// What must be below the position found; `ground` as for above_ground().
enum class Below : std::uint8_t { anything, ground };

/// The nearest position found, at most `limit` metres away, where the body fits with its skin. The search pushes the
/// body out of its contacts, and also goes in the 26 directions from a cube's centre to its neighbours. In each of
/// these it skips no free part of the way; after 128 positions none longer than a 128th of `limit`.
[[nodiscard]] std::optional<Vec3> nearest_free(const Space& space, const Body& body, const Vec3& place, double limit,
                                               double skin, Way way, Below below = Below::anything);

}  // namespace roam::walking
