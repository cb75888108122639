#pragma once
/// \file
/// One stride over the ground.

#include "motion/gait.h"
#include "motion/move.h"

namespace roam::walking {

/// Greatest duration of a stride at this velocity, seconds: so short that the body looks for ground at least every half
/// radius. Otherwise it would leap over cracks that it cannot cross. A stride that loses the ground is undone and
/// repeated in fine strides of a twelfth of the radius. They are so short that the body follows the rim down, at any
/// speed, as far as it carries.
[[nodiscard]] double stride_seconds(const Move& move, const Vec3& velocity);
[[nodiscard]] double fine_stride_seconds(const Move& move, const Vec3& velocity);

/// Moves at the horizontal `velocity` for `seconds`: along the ground, up steps, under low obstacles, along walls. Then
/// stays on the ground below. The speed is that seen from above. False if the body is embedded.
bool stride(Move& move, Gait& gait, const Vec3& velocity, double seconds);

}  // namespace roam::walking
