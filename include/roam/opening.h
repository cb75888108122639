#pragma once
/// \file
/// Openings: the narrowest place of a way (see passage.h), or the one that stops a walker (measure_opening()). In
/// metres.

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
    gap,     ///< flying: any two sides; not from measure_opening()
  };
  Kind kind = Kind::door;
  Vec3 point{0.0};      ///< half way between the two sides; in a way, at the height where they are nearest
  double width = 0.0;   ///< from one side to the other; in a way, twice the largest radius that passes
  Vec3 direction{0.0};  ///< unit vector from one side to the other
};
[[nodiscard]] const char* to_string(Opening::Kind kind);  ///< "door", "lintel" or "gap"

/// The contact of the step, the ground included, whose normal points most directly against `way`. Null if there is no
/// contact.
[[nodiscard]] const Contact* most_against(const StepReport& report, const Vec3& way);

/// The opening in front of a blocked body: the nearest pair of contacts on either side of its way (door) or above and
/// below it (lintel) between which a ray passes. Measured at the height of the contacts, to a few millimetres, among
/// the nearest 48 triangles within four skins of the body. None for a closed wall and for a vertical way. `ahead` is
/// the unit vector of the blocked way. Allocates nothing; thread-safe while nothing moves the walker.
[[nodiscard]] std::optional<Opening> measure_opening(const Walker& walker, const Vec3& ahead);

}  // namespace roam
