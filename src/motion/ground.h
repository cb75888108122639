#pragma once
/// \file
/// What can be stood on, staying on it, and stepping onto it.

#include <optional>

#include "motion/gait.h"
#include "motion/move.h"
#include "roam/support.h"

namespace roam::walking {

/// Ground under a body.
struct Ground {
  Vec3 normal{0.0, 0.0, 1.0};  ///< of the ground to walk along
  double level = 0.0;          ///< z of the point of contact, metres
  bool firm = true;            ///< within the slope limit: not on a rim, not wedged
  bool edge = false;           ///< the contact is with an edge or a corner, where ground may begin
  bool unknown = false;        ///< it is what is not known yet that carries
  ObjectId object = no_object;
};

/// Whether the body can stand on what it touches:
///   - on anything whose normal is within the slope limit; or
///   - on the rim of a floor that is within the slope limit, however steep the body's own contact with the rim is, as
///     long as it is not steeper than rim_slope_degrees: that is how a round body climbs stairs and crosses cracks.
/// Where the body has stood, an edge or corner also must not lie higher than one step above that level: without this a
/// big round body rolls up what it could not step onto.
[[nodiscard]] std::optional<Ground> footing(const Move& move, const Gait& gait, const Impact& contact);

/// The same for everything that the body touches where it is. A body wedged between steep planes stands too, when
/// gravity along them leads down at less than the slope limit.
[[nodiscard]] std::optional<Ground> footing_here(const Move& move, const Gait& gait);

/// After a stride of `horizontal` metres over the ground: goes down to the ground, or up to its skin, when there is
/// footing within reach; else the body is in the air.
void keep_ground(Move& move, Gait& gait, double horizontal);

/// Stands on `ground` now.
void stand_on(Move& move, Gait& gait, const Ground& ground);

/// Steps from firm ground onto what blocks the way along the horizontal `motion`: up, forward, down. Returns the part
/// of the motion that was made, or nothing when there is no footing to step to; then the body has not moved. Longer
/// than the motion when that is too short to get onto the rim.
[[nodiscard]] std::optional<double> step_up(Move& move, Gait& gait, const Vec3& motion, double seconds);

}  // namespace roam::walking
