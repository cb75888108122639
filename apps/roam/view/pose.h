#pragma once
/// \file
/// Position and direction of a body.

#include "roam/math.h"

namespace roam::app {

/// `position`: the body's centre, in metres, in the scene's frame. Angles in degrees: `yaw` 0 looks along +x, 90 along
/// +y; `pitch` 90 looks straight up.
struct Pose {
  Vec3 position{0.0};
  double yaw = 0.0;
  double pitch = 0.0;
};

}  // namespace roam::app
