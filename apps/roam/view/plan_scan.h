#pragma once
/// \file
/// The walls of a space in a level plane, found by rays.

#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "roam/space.h"

namespace roam::app {

/// The square to scan.
struct PlanArea {
  Vec3 centre{0.0};      ///< the height of the plane is its z
  double half = 15.0;    ///< m: half the side
  double spacing = 0.1;  ///< m: between two rays; smaller objects may be missed
};

/// Pieces of the walls, as pairs of points in metres from the area's centre. A piece is as long as the spacing, or
/// sqrt(2) of it: rays along x find walls that face x rather than y, and rays along y the others. Surfaces within 1 cm
/// behind another one are left out, and so is unknown space. Calls `goes_on` now and then; false throws Cancelled.
[[nodiscard]] std::vector<glm::vec2> scan_plan(const Space& space, const PlanArea& area,
                                               const std::function<bool()>& goes_on);

}  // namespace roam::app
