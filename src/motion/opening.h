#pragma once
/// \file
/// How wide, or high, the opening is that a body does not fit through.

#include <optional>

#include "roam/space.h"
#include "roam/step_report.h"

namespace roam::walking {

struct Opening {
  double size = 0.0;       ///< metres
  bool is_height = false;  ///< between what is below and what is above, not from side to side
  Vec3 middle{0.0};        ///< half way between the two points
};

/// A contact is what the opening is measured from when it is within this many of the body's skins.
inline constexpr double opening_skins = 4.0;

/// The contact of a step, the ground included, whose normal points most against the way; null where there is none.
[[nodiscard]] const Contact* most_against(const StepReport& report, const Vec3& way);

/// The opening ahead of a blocked body, see Blockage::opening: the least distance of two points that the body touches
/// on either side of its way (or above and below), if a ray between them finds it open. `ahead`: unit vector of the way
/// that is blocked. `reach`: how near a triangle must be to count as touched, metres.
[[nodiscard]] std::optional<Opening> measure_opening(const Space& space, const Body& body, const Vec3& place,
                                                     const Vec3& ahead, double reach);

}  // namespace roam::walking
