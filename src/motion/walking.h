#pragma once
/// \file
/// Walk mode: strides over the ground, and flight through the air between them.

#include "motion/gait.h"
#include "motion/move.h"
#include "motion/sizes.h"

namespace roam::walking {

/// m/s. Greatest speed of a fall: about the terminal speed of a person.
constexpr double terminal_speed = 55.0;

/// A position to put the body back to, and its size there.
struct Refuge {
  Vec3 place{0.0};
  double height = 0.0;  ///< metres; 0: none yet
  Size size;
};

/// Walks at the horizontal `velocity` for `dt` seconds, stride by stride, in the air and on the ground, in the size
/// wanted there. `last`: last firm standing position.
Ending walk(Move& move, Gait& gait, const Vec3& velocity, double dt, Refuge& last, const Sizes& sizes);

/// Takes off, if the body stands and its settings let it jump.
void jump(Move& move, Gait& gait);

}  // namespace roam::walking
