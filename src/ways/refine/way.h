#pragma once
/// \file
/// From many stations to few points along which a body can move.

#include "ways/refine/stations.h"

namespace roam::ways {

/// Metres. A way is certified for its radius less this: sweeps report a hit if a triangle is this much too near.
[[nodiscard]] double certified_margin(const Survey& survey);

/// Inserts stations where a body of `radius` cannot go straight from one station to the next. Returns the radius, at
/// most `radius`, for which the whole way is certified.
[[nodiscard]] double mend(const Survey& survey, const Measure& measure, Stations& way, double radius, double spacing);

/// Removes stations on straight pieces, if the pieces are about as wide as the way along the stations. Each piece lets
/// a body of `radius` pass.
[[nodiscard]] std::vector<Vec3> straightened(const Survey& survey, const Measure& measure, const Stations& way,
                                             double radius);

}  // namespace roam::ways
