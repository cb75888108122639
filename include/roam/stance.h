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
  falling,  ///< nothing, and the body is more than Walker::fall_limit() below where it last stood
  ground,   ///< ground within the slope limit
  rim,      ///< the rim of a crack or of a step, or slopes between which the body is wedged; it does not step up there
  foot,     ///< its foot alone, over a crack: see WalkerSettings::support_radius
};

struct Stance {
  Footing footing = Footing::air;
  bool unknown = false;         ///< what carries the body is not known yet (space.h); false in the air
  Vec3 ground{0.0, 0.0, 1.0};   ///< unit normal of the ground stood on now or last
  std::optional<double> level;  ///< z of the point stood on now or last, metres; none: not stood since it was placed
  ObjectId object = no_object;  ///< that carries the body, or carried it last
  /// Of the ground at the feet, metres per second, as roam::advance() moved it last; 0 where it does not move. In the
  /// air: what the body has taken along from moving ground, horizontal, until it lands.
  Vec3 velocity{0.0};

  /// Whether anything carries the body.
  [[nodiscard]] bool grounded() const { return footing != Footing::air && footing != Footing::falling; }
  /// Whether that is ground within the slope limit, or the foot over it.
  [[nodiscard]] bool firm() const { return footing == Footing::ground || footing == Footing::foot; }
};

}  // namespace roam
