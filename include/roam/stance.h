#pragma once
/// \file
/// How a walker stands: Walker::stance().

#include <cstdint>
#include <optional>

#include "roam/math.h"
#include "roam/space.h"

namespace roam {

/// What carries a body in walk mode; `air` in the other modes.
enum class Footing : std::uint8_t {
  air,      ///< nothing: the body jumps, falls or slides down what is too steep
  falling,  ///< nothing, and it has dropped more than Walker::fall_limit(); an ordinary fall is `air`
  ground,   ///< ground within the slope limit
  rim,      ///< the rim of a crack or of a step, or slopes between which the body is wedged; it cannot step up
  foot,     ///< its foot alone, over a crack: see WalkerSettings::support_radius
};

struct Stance {
  Footing footing = Footing::air;
  bool unknown = false;         ///< what carries the body is not known yet (space.h); false in the air
  Vec3 ground{0.0, 0.0, 1.0};   ///< unit normal of the ground stood on now or last
  std::optional<double> level;  ///< z of the point stood on now or last, metres; none: not stood since it was placed
  /// That carries the body, or carried it last. An instance may have been removed since (Instances::has).
  ObjectId object = no_object;
  /// Of the ground at the feet, metres per second, as move_instances() moved it last; 0 where it stands still. In the
  /// air: what the ground had when the body left it, kept until it lands.
  Vec3 ground_velocity{0.0};

  /// Whether anything carries the body.
  [[nodiscard]] bool grounded() const { return footing != Footing::air && footing != Footing::falling; }
  /// Whether that is ground within the slope limit, or the foot over it.
  [[nodiscard]] bool firm() const { return footing == Footing::ground || footing == Footing::foot; }
};

}  // namespace roam
