#pragma once
/// \file
/// How a body stands at a place of the floor, and where the floor is.

#include <optional>

#include "train/lattice.h"

namespace roam::training {

/// A body that is free at a place: its radius, and by how much it is lifted off the place (m).
struct Stand {
  double radius = 0.0;
  double lift = 0.0;  ///< spheres only: over bumps, kerbs and slopes, in [0, step]
};

/// The largest radius that is looked for: measure.widest, or what the height leaves above the knee.
[[nodiscard]] double largest_radius(const Measure& measure);

/// What is swept and asked for: of a sphere, itself; of a capsule, its part above the knee.
[[nodiscard]] Body body_of(const Measure& measure, double radius);
[[nodiscard]] Vec3 centre_of(const Measure& measure, const Vec3& place, const Stand& stand);

/// The largest body up to `largest` that is free at a place of the floor; none where that is less than `least`.
[[nodiscard]] std::optional<Stand> stand_at(const Survey& survey, const Measure& measure, const Vec3& place,
                                            double largest, double least);

/// The floor that a foot comes to from a place at height `level`; see foot_at. `carried`: over a crack too.
[[nodiscard]] std::optional<Vec3> floor_below(const Survey& survey, const Measure& measure, double x, double y,
                                              double level);
[[nodiscard]] std::optional<Vec3> carried_over(const Survey& survey, const Measure& measure, double x, double y,
                                               double level);

}  // namespace roam::training
