#pragma once
/// \file
/// Places for a body that stands: from those of its feet, and found in a space. Target roam::roam.
///
///     const roam::WalkerSettings person;
///     const std::optional<roam::Vec3> start = roam::place_to_stand(world, person, {2.0, 3.0, 0.0}, 5.0);
///     if (start) roam::Walker walker(world, person, roam::Mode::walk, *start);

#include <optional>
#include <span>
#include <vector>

#include "roam/math.h"
#include "roam/space.h"
#include "roam/walker_settings.h"

namespace roam {

/// Where the centre of the standing body is whose lowest point is at each of `feet`, metres: half its height above. For
/// ways of the feet, such as Passage::way and those of train(), that are to become a Route.
[[nodiscard]] std::vector<Vec3> standing(std::span<const Vec3> feet, const WalkerSettings& settings);

/// Where a body can stand, as near to `near` as one is found: of its centre, metres, for Walker::place. It fits there,
/// stands firmly, within the slope limit, on what is known, and is at most `within` (m, > 0, <= Space::reach_limit)
/// from `near`, measured from the centre. None where none is found: places are tried a radius apart, but at most 4096
/// from above. Nothing is said about the way from `near` to there: a wall may be between.
///
/// Takes a microsecond to some, for each place that is tried. Throws roam::Error for settings out of range, and for a
/// `near` or a `within` that is not as said.
[[nodiscard]] std::optional<Vec3> place_to_stand(const Space& space, const WalkerSettings& settings, const Vec3& near,
                                                 double within);

}  // namespace roam
