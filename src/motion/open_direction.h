#pragma once
/// \file
/// The direction in which most is open.

#include "roam/space.h"

namespace roam {

struct OpenDirection {
  double yaw = 0.0;     ///< degrees
  double length = 0.0;  ///< metres that are open there, on average over a sixth of the horizon, most of all its middle
};

/// The level direction from `eye` in which most is open, up to `reach` metres and within the bounds of the space. Views
/// through slits count for nothing.
[[nodiscard]] OpenDirection open_direction(const Space& space, const Vec3& eye, double reach);

}  // namespace roam
