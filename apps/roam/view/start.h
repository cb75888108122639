#pragma once
/// \file
/// Where a session begins when nobody says it.

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "roam/store.h"
#include "roam/walker.h"
#include "view/pose.h"

namespace roam::app {

struct StartPlace {
  Pose pose;
  Mode mode = Mode::walk;  ///< that was wished for, or fly where there is no floor to walk on
  std::string note;        ///< a sentence for the user when it is not as wished
};

/// A free place, on a floor and inside where there is an inside (see
/// wander_start, also for `floors`), looking where there is most to see.
/// Where the body fits on no floor: in the air, flying; where it fits nowhere: outside of everything, flying. `goes_on`
/// is asked now and then, and ends it by false: roam::Cancelled.
[[nodiscard]] StartPlace find_start(const Space& space, const WalkerSettings& settings, Mode mode,
                                    std::span<const Vec3> floors, const std::function<bool()>& goes_on);

/// The same in a store, looking around a few places of it only; see free_start.
[[nodiscard]] StartPlace find_start(const Store& store, std::uint64_t memory, const WalkerSettings& settings, Mode mode,
                                    const std::function<bool()>& goes_on);

/// The level direction, in degrees, in which one sees farthest from `eye` before a wall.
[[nodiscard]] double open_yaw(const Space& space, const Vec3& eye);

/// From where all of `box` is seen by a camera of this field of view (degrees, of the smaller side of the picture).
[[nodiscard]] Pose overview(const Box& box, double fov);

}  // namespace roam::app
