#pragma once
/// The promise of a certified sweep of tolerance 0.

#include "sweep/certified.h"
#include "sweep/gap_line.h"

namespace roam::certified {

/// Metres. Upper bound of the distance from the radius at which a hit of tolerance 0 may be, beyond the triangle's own
/// corner_error: hit_factor times the error bound at t_end.
[[nodiscard]] inline double hit_resolution(const Body& body, const Vec3& motion, const LocalTriangle& triangle,
                                           double t_end) {
  return hit_factor * error_bound(body, motion, triangle).at(t_end);
}

}  // namespace roam::certified
