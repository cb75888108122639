#pragma once
/// \file
/// Edges inside a floor: those that two of its triangles share, one on each side.

#include <cstdint>
#include <vector>

#include "roam/survey.h"

namespace roam::training {

/// Of each of survey.floor_triangles(): bit k is set where the edge from corner k to the next is also, with the same
/// two corners as numbers, whatever their order, an edge of a floor that lies on its other side in the plan. Nothing
/// can be told from a bit that is not set: floors may meet without such an edge. Takes 50 bytes a floor for a while. On
/// all cores; the answer does not depend on them.
[[nodiscard]] std::vector<std::uint8_t> shared_edges(const Survey& survey);

}  // namespace roam::training
