#pragma once
/// \file
/// An opening: the narrowest place of a way, or what a body does not fit through.
///
///     if (walker.report().blocked)
///       if (const auto opening = roam::measure_opening(walker, ahead))
///         std::cout << to_string(opening->kind) << " " << opening->width << " m\n";
///
/// passage.h finds the narrowest opening of the widest way between two places.

#include <cstdint>
#include <optional>

#include "roam/math.h"
#include "roam/step_report.h"

namespace roam {

class Walker;

struct Opening {
  enum class Kind : std::uint8_t {
    door,    ///< walls on both sides
    lintel,  ///< something above, and floor or something below
    gap,     ///< flying: any two sides
  };
  Kind kind = Kind::door;
  Vec3 point{0.0};      ///< its middle, half way between the two sides; of a way, at the height where they are nearest
  double width = 0.0;   ///< m, from one side to the other; of a way, twice the largest radius that passes
  Vec3 direction{0.0};  ///< unit, from one side to the other
};

/// "door", "lintel" or "gap".
[[nodiscard]] const char* to_string(Opening::Kind kind);

/// The contact that stands most against `way` among all that a step touched, the ground included; null where nothing
/// was touched.
[[nodiscard]] const Contact* most_against(const StepReport& report, const Vec3& way);

/// The opening in front of a blocked body: the two points nearest to each other that the body touches on either side of
/// its way (a door) or above and below (a lintel), provided that a ray between them goes on behind them. Measured at
/// the height of the contacts, to a few millimetres. None where the wall is closed.
///
/// `ahead` is the unit vector of the blocked way; none is found along a vertical one. A triangle counts as touched when
/// it is within four skins of the body. Const and safe to call while nobody moves the walker; allocates nothing.
[[nodiscard]] std::optional<Opening> measure_opening(const Walker& walker, const Vec3& ahead);

}  // namespace roam
