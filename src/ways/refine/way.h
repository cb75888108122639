#pragma once
/// \file
/// From many stations to few points that a body can be led along.

#include "ways/refine/stations.h"

namespace roam::ways {

/// Metres. A way is certified for its radius less this: sweeps answer a hit where a triangle is that much too near.
[[nodiscard]] double certified_margin(const Survey& survey);

/// Puts stations between those that a body of `radius` does not go straight between. Returns the radius, at most
/// `radius`, for which all of the way is certified.
[[nodiscard]] double mend(const Survey& survey, const Measure& measure, Stations& way, double radius, double spacing);

/// Leaves out what lies on straight pieces where a body passes about as well as along the stations, and at least one
/// of `radius`.
[[nodiscard]] std::vector<Vec3> straightened(const Survey& survey, const Measure& measure, const Stations& way,
                                             double radius);

}  // namespace roam::ways
