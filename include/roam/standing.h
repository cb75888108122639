#pragma once
/// \file
/// Positions for a standing body: from those of its feet, or found in a space. Lengths are metres.
///
///     const std::optional<roam::Vec3> start = roam::place_to_stand(world, settings, {2.0, 3.0, 0.0}, 5.0);
///     if (start) roam::Walker walker(world, settings, roam::Mode::walk, *start);

#include <optional>
#include <span>
#include <vector>

#include "roam/math.h"
#include "roam/space.h"
#include "roam/walker_settings.h"

namespace roam {

/// The centres of the standing body whose lowest point is at each of `feet`: half its height above. Turns paths of the
/// feet, such as Passage::way and those of train(), into waypoints of a Route.
[[nodiscard]] std::vector<Vec3> standing(std::span<const Vec3> feet, const WalkerSettings& settings);

/// The centre, for Walker::place(), of a body that stands upright and firmly, within the slope limit, on known space.
/// The nearest centre found at most `within` from `near`, or none. Tries columns about a radius apart, at most 4096,
/// and at most 64 floors in each, for some microseconds a floor. A wall may lie between `near` and the result. Throws
/// roam::Error for settings out of range, a `near` that is not finite and a `within` not in (0, Space::reach_limit].
[[nodiscard]] std::optional<Vec3> place_to_stand(const Space& space, const WalkerSettings& settings, const Vec3& near,
                                                 double within);

}  // namespace roam
