#pragma once
/// \file
/// Distance of a moving body from a triangle by elementary geometry in long double: the second opinion by which
/// --verify judges the certified one. It shares no formula with src/sweep.

#include "roam/math.h"
#include "roam/mesh.h"

namespace roam::verification {

/// The least distance, in metres, between `triangle` and all that the vertical axis of length 2 * `half_height` passes
/// while its centre moves straight from `from` to `to`. 0 when they meet.
///
/// What the axis passes is a parallelogram (a segment or a point in the simple cases), and the distance of two flat
/// convex shapes is that of two of their edges, or of a corner of one and the face of the other, or 0 when an edge of
/// one pierces the other (Ericson, Real-Time Collision Detection, 2005, 5.1). Each candidate is the distance
/// of two points that are computed to lie on the shapes, so rounding can only make the answer larger than it is: by
/// about 1e-18 of the distance to the origin of coordinates and of the shapes' sizes.
[[nodiscard]] long double swept_distance(const Vec3& from, const Vec3& to, double half_height,
                                         const Triangle& triangle);

}  // namespace roam::verification
