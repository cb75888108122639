#pragma once
/// \file
/// The stance of a walker: the ground, rim or disc that carries it. See Walker::stance().

#include <cstdint>
#include <optional>

#include "roam/math.h"
#include "roam/space.h"

namespace roam {

/// The support of a body in walk mode; `air` in the other modes.
enum class Footing : std::uint8_t {
  air,      ///< nothing: the body jumps, falls or slides down a steep slope
  falling,  ///< nothing, and it has dropped by more than Walker::fall_limit()
  ground,   ///< ground within the slope limit
  rim,      ///< the rim of a crack or step, or slopes that wedge the body; it cannot step up
  disc,     ///< the support disc alone, over a crack: see WalkerSettings::support_radius
};

struct Stance {
  Footing footing = Footing::air;
  bool unknown = false;         ///< unknown space carries the body; false in the air
  Vec3 ground{0.0, 0.0, 1.0};   ///< unit normal of the ground stood on now or last
  std::optional<double> level;  ///< z, in metres, of the point stood on now or last; none: not stood since it was put
  ObjectId object = no_object;  ///< that carries the body now or last; it may be gone (see Instances::has())
  /// m/s: of the ground at the lowest point, as move_instances() moved it last; in the air, of the ground left last.
  Vec3 ground_velocity{0.0};
  [[nodiscard]] bool grounded() const { return footing != Footing::air && footing != Footing::falling; }
  /// Whether ground within the slope limit, or the support disc, carries the body.
  [[nodiscard]] bool firm() const { return footing == Footing::ground || footing == Footing::disc; }
};

}  // namespace roam
