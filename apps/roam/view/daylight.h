#pragma once
/// \file
/// How much of the sky the eye sees: the light outdoors and in rooms differs.

#include "roam/space.h"

namespace roam::app {

/// The share of the sky that is not behind a surface at `eye`, in [0, 1]: nine directions within 55 degrees of the
/// zenith. Directions that end in unknown space do not count; 1 if all do.
[[nodiscard]] double open_sky(const Space& space, const Vec3& eye);

/// The same over time: it follows the eye within a second or two, as an eye gets used to light.
class Daylight {
 public:
  /// Takes what open_sky() is after `seconds`, > 0, or at once the first time. Returns the present share.
  double follow(double sky, double seconds);

 private:
  double share_ = -1.0;
};

}  // namespace roam::app
