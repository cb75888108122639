#pragma once
/// \file
/// Round bodies over gaps whose rims differ in level.

#include <optional>
#include <span>
#include <vector>

#include "cracks/cracks.h"

namespace roam::training {

/// m: rims that differ by less are level, but for the roughness of floors and for what storing moves.
inline constexpr double level_rims = 5e-3;

/// The least radius of a body that rolls over a gap of half width `half` onto a rim that is `rise` (m) higher, on
/// floors within `slope_degrees`. The body is then at the distance of its radius from both rims. It is carried by the
/// higher one where it touches that at no more than 70 degrees; and where it touches the lower one within the slope
/// limit it stands firmly, and steps up. Of level rims carried_share of the half width.
[[nodiscard]] double carried_from(double half, double rise, double slope_degrees);

/// How much higher one rim of a crack is than the one opposite, where it is widest, m. `step`: rims no farther above or
/// below are its own.
[[nodiscard]] double rise_of(const Survey& survey, const Crack& crack, double step);

/// The place `along` (m) a way; one of its ends where that lies beyond it.
[[nodiscard]] Vec3 place_on(std::span<const Vec3> way, double along);

/// The part of a way without floor.
struct GapOnWay {
  double from = 0.0, to = 0.0;  ///< m along the way
  double beyond = 0.0;          ///< m of the way after it
  double rise = 0.0;            ///< m, of the floor there over the floor before it
};

/// The gap that a way comes to about `at` (m along it), of a crack of half width `half`: the first that is not far
/// narrower, and no longer than three such cracks.
[[nodiscard]] std::optional<GapOnWay> gap_on(const Survey& survey, std::span<const Vec3> way, double at, double half,
                                             double step);

/// Where a way leads down over a gap: the way back, up over it. Empty where the rims are level, or where the way begins
/// or ends so near to the gap that a body of the radius does not stand there.
[[nodiscard]] std::vector<Vec3> back_over(const Survey& survey, std::span<const Vec3> way, const GapOnWay& gap,
                                          double radius, double step);

}  // namespace roam::training
