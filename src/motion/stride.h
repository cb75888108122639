#pragma once
/// \file
/// One stride over the ground.

#include "motion/gait.h"
#include "motion/move.h"

namespace roam::walking {

/// How long a stride at this velocity may last, seconds: so short that the body looks for ground at least every half
/// radius, or it would leap cracks that it can not cross. A stride that loses the ground is taken back and made again
/// in fine ones, a twelfth of the radius each: so short that the body follows the rim down, at any speed, as far as it
/// carries.
[[nodiscard]] double stride_seconds(const Move& move, const Vec3& velocity);
[[nodiscard]] double fine_stride_seconds(const Move& move, const Vec3& velocity);

/// Goes at the horizontal `velocity` for `seconds`: along the ground, up steps, under what is low, along walls; then
/// keeps to the ground below. The speed is that seen from above. False when the body is embedded.
bool stride(Move& move, Gait& gait, const Vec3& velocity, double seconds);

}  // namespace roam::walking
