#pragma once
/// \file
/// A body and a box of which nothing is known: certified answers, as for triangles, but the box is solid.
///
/// A capsule and a box are as far apart as its centre and the box made taller by the half height, up and down. So all
/// is done with a point and a box. The signed distance of the two, negative inside, is convex along a straight way, and
/// at any place it is bounded from below everywhere by the plane through the closest point (inside: the plane of the
/// nearest side). The advance of sweep/certified.h therefore serves here too, and shorter: see unknown.cpp.

#include "roam/space.h"

namespace roam::unknown {

/// First impact of the body with the box, from which `margin` (m) is kept beside the radius. A body inside is hit at
/// time 0, and its normal is the shortest way out. `triangle` is the side of the box, 0 to 5, that faces the body.
[[nodiscard]] Impact sweep(const Box& box, double margin, const Body& body, const Vec3& from, const Vec3& motion);

/// Where the body comes closest to the box on its way, as Space::contacts says, the margin taken off the distance.
[[nodiscard]] Contact nearest(const Box& box, double margin, const Body& body, const Vec3& from, const Vec3& motion);

/// Sides of a box.
inline constexpr TriangleId sides = 6;

}  // namespace roam::unknown
