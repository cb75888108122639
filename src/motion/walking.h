#pragma once
/// \file
/// Walk mode: strides over the ground, and flight through the air between them.

#include "motion/move.h"
#include "motion/sizes.h"

namespace roam::walking {

/// Nobody falls faster than this, metres per second: about the terminal speed of a person.
constexpr double terminal_speed = 55.0;

/// Where the body last stood firmly, kept up to date by walk().
struct LastStand {
  Vec3& place;
  double& height;
  Size& size;
};

/// Walks at the horizontal `velocity` for `dt` seconds, stride by stride, in the air and on the ground, in the size
/// that is wanted there.
Ending walk(Move& move, Stance& stance, const Vec3& velocity, double dt, const LastStand& last, const Sizes& sizes);

/// Takes off, when the body stands and its settings let it jump.
void jump(Move& move, Stance& stance);

}  // namespace roam::walking
