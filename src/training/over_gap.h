#pragma once
/// \file
/// Round bodies over gaps whose rims differ in level.

#include <optional>
#include <span>
#include <vector>

#include "cracks/cracks.h"

namespace roam::training {

/// m: rims that differ by less are level. Covers the roughness of floors and the rounding of stores.
inline constexpr double level_rims = 5e-3;

/// The least radius of a body that rolls over a gap of half width `half` onto a rim that is `rise` (m) higher, on
/// floors within `slope_degrees`. There the body's centre is one radius from both rims. The higher rim carries it if it
/// touches that rim at no more than 70 degrees. If it touches the lower rim within the slope limit, it stands firmly
/// and steps up. For level rims: carried_share of the half width.
[[nodiscard]] double carried_from(double half, double rise, double slope_degrees);

/// m, the height of one rim of a crack above the opposite one, where the crack is widest. `step`: rims farther above or
/// below do not count.
[[nodiscard]] double rise_of(const Survey& survey, const Crack& crack, double step);

/// The place `along` (m) a way, or its nearest end.
[[nodiscard]] Vec3 place_on(std::span<const Vec3> way, double along);

/// A part of a way without floor.
struct GapOnWay {
  double from = 0.0, to = 0.0;  ///< m along the way
  double beyond = 0.0;          ///< m of the way after the gap
  double rise = 0.0;            ///< m, height of the floor after the gap above the floor before it
};

/// The gap on a way at about `at` (m along it), for a crack of half width `half`: the first one that is not far
/// narrower and no longer than three such cracks.
[[nodiscard]] std::optional<GapOnWay> gap_on(const Survey& survey, std::span<const Vec3> way, double at, double half,
                                             double step);

/// The way back up over a gap that a way crosses downwards. Empty if the rims are level, or if the way begins or ends
/// too near to the gap for a body of that radius to stand.
[[nodiscard]] std::vector<Vec3> back_over(const Survey& survey, std::span<const Vec3> way, const GapOnWay& gap,
                                          double radius, double step);

}  // namespace roam::training
