#pragma once
/// \file
/// Distance of a moving body from a triangle by elementary geometry in long double, for --verify. It shares no formula
/// with src/sweep.

#include "roam/math.h"
#include "roam/mesh.h"

namespace roam::verification {

/// The least distance, in metres, between `triangle` and the vertical axis of length 2 * `half_height`, while its
/// centre moves straight from `from` to `to`. 0 if they meet.
///
/// The axis sweeps a parallelogram (in simple cases a segment or a point). Two flat convex shapes are as far apart as
/// two of their edges, or a corner of one and the face of the other. The distance is 0 if an edge of one pierces the
/// other (Ericson, Real-Time Collision Detection, 2005, 5.1). Each candidate is the distance of two computed points on
/// the shapes, so rounding can only make the result larger than it is. The error is about 1e-18 of the distance to the
/// origin and of the shapes' sizes.
[[nodiscard]] long double swept_distance(const Vec3& from, const Vec3& to, double half_height,
                                         const Triangle& triangle);

}  // namespace roam::verification
