#pragma once
/// \file
/// A camera on a circle around the scene: `roam view --turntable`.

#include "roam/math.h"
#include "view/pose.h"

namespace roam::app {

/// The pose after `share` of a turn, in which a camera sees all of `box` about as large as a full turn allows. It looks
/// down on the middle of the box. `fov`: degrees, vertical; `aspect`: width divided by height.
[[nodiscard]] Pose on_turntable(const Box& box, double fov, double aspect, double share);

}  // namespace roam::app
