#pragma once
/// \file
/// Ground to stand on: finding it, staying on it, and stepping onto it.

#include <optional>

#include "motion/carrying.h"
#include "motion/gait.h"
#include "motion/move.h"

namespace roam::walking {

/// The ground under a body.
struct Ground {
  Vec3 normal{0.0, 0.0, 1.0};  ///< of the ground to walk along
  double level = 0.0;          ///< z of the point of contact, metres
  bool firm = true;            ///< within the slope limit: not on a rim, not wedged
  bool edge = false;           ///< the contact is with an edge or a corner, where ground may begin
  bool unknown = false;        ///< the ground is unknown space
  ObjectId object = no_object;
};

/// Whether the body can stand on what it touches. It can stand on
///   - anything whose normal is within the slope limit; or
///   - the rim of a floor within the slope limit, however steep the body's own contact with the rim is, up to
///     rim_slope_degrees: that is how a round body climbs stairs and crosses cracks.
/// Once the body has stood, an edge or corner also must not lie higher than one step above that level. Otherwise a big
/// round body would roll up obstacles that it could not step onto.
[[nodiscard]] std::optional<Ground> footing(const Move& move, const Gait& gait, const Impact& contact);

/// The same for all contacts of the body at its position. A body wedged between steep planes stands too, if gravity
/// along them leads down at less than the slope limit.
[[nodiscard]] std::optional<Ground> footing_here(const Move& move, const Gait& gait);

/// Called after a stride of `horizontal` metres over the ground. Moves down to the ground, or up to the skin, if there
/// is footing within reach; otherwise the body is in the air.
void keep_ground(Move& move, Gait& gait, double horizontal);

/// Makes the body stand on `ground`.
void stand_on(Move& move, Gait& gait, const Ground& ground);

/// Steps from firm ground onto the obstacle along the horizontal `motion`: up, forward, down. Returns the part of the
/// motion that was made; it is more than 1 if the motion is too short to get onto the rim. Returns nothing if there is
/// no footing to step to; then the body has not moved.
[[nodiscard]] std::optional<double> step_up(Move& move, Gait& gait, const Vec3& motion, double seconds);

}  // namespace roam::walking
