#pragma once
/// \file
/// Where a way begins and ends, and where it breaks off.

#include <optional>

#include "ways/lattice/lattice.h"

namespace roam::ways {

/// The place of a body of `narrowest` that is meant by a point: on foot the floor there, or below; where nobody fits,
/// the nearest at most 2 m away and in sight. None where there is none.
[[nodiscard]] std::optional<Vec3> free_end(const Survey& survey, const Measure& measure, const Vec3& point);

/// Where two trees that do not meet come nearest to each other: half way, of no width, across what parts them.
[[nodiscard]] std::optional<Opening> gap_between(const WidestTree& tree, NodeId one, NodeId other);

/// Whether two such trees come near each other where no wall is between, only a step or a gap of the floor: `narrowest`
/// goes straight from a place of the one to the nearest of the other.
[[nodiscard]] bool only_floor_parts(const Survey& survey, const Measure& measure, const WidestTree& tree, NodeId one,
                                    NodeId other);

}  // namespace roam::ways
