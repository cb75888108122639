#pragma once
/// \file
/// Collide and slide: free motion among walls.

#include "motion/move.h"

namespace roam::walking {

/// A slide ends after this many contacts, and the rest of its motion is dropped. Corners need 3; a facetted curve needs
/// one for each facet passed in one step.
constexpr int slide_limit = 16;

/// Moves by `velocity` for `dt` seconds and slides along obstacles.
Ending slide(Move& move, const Vec3& velocity, double dt);

}  // namespace roam::walking
