#pragma once
/// \file
/// Ways out for a body that does not fit where it is.

#include <optional>

#include "roam/space.h"

namespace roam::walking {

/// Whether a body that falls from `place` comes down on something, known or not.
[[nodiscard]] bool above_ground(const Space& space, const Body& body, const Vec3& place);

/// `checked`: only ways on which a sphere about the body's centre, of nine tenths of the centre's own distance from
/// everything, meets nothing, so that the centre stays on its side of every wall. A body whose centre lies on a
/// triangle has no such way. `any`: through walls too.
enum class Way : std::uint8_t { checked, any };
/// What the place must have below it: `ground`, as above_ground() says.
enum class Below : std::uint8_t { anything, ground };

/// The nearest place found, at most `limit` metres away, where the body fits with its skin. Looked for by pushing the
/// body out of what it touches, and along the 26 directions to the neighbours of a cube's centre, on each of which no
/// free place is skipped.
[[nodiscard]] std::optional<Vec3> nearest_free(const Space& space, const Body& body, const Vec3& place, double limit,
                                               double skin, Way way, Below below = Below::anything);

}  // namespace roam::walking
