#pragma once
/// \file
/// The ends of a way, and the place where it breaks off.

#include <optional>

#include "ways/lattice/lattice.h"

namespace roam::ways {

/// The place for a body of `narrowest` at a point. On foot this is the floor at the point or below. If the body does
/// not fit there: the nearest place at most 2 m away and in sight. None if there is no such place.
[[nodiscard]] std::optional<Vec3> free_end(const Survey& survey, const Measure& measure, const Vec3& point);

/// The nearest places of two trees that do not meet, as an opening of no width half way between them.
[[nodiscard]] std::optional<Opening> gap_between(const WidestTree& tree, NodeId one, NodeId other);

/// Whether two such trees come near each other with only a step or a gap of the floor between them, and no wall. Then
/// `narrowest` goes straight from a place of the one to the nearest of the other.
[[nodiscard]] bool only_floor_separates(const Survey& survey, const Measure& measure, const WidestTree& tree,
                                        NodeId one, NodeId other);

}  // namespace roam::ways
