#pragma once
/// \file
/// A body and an unknown box: certified results as for triangles, but the box is solid.
///
/// The distance of a capsule and a box is that of the capsule's centre and the box extended by the half height, up and
/// down. So everything reduces to a point and a box. Their signed distance, negative inside, is convex along a straight
/// motion. The plane through the closest point (inside: the plane of the nearest side) bounds it from below everywhere.
/// So the method of sweep/certified.h works here too, in a shorter form: see unknown.cpp.

#include "roam/space.h"

namespace roam::unknown {

/// First impact of the body with the box; `margin` (m) is kept in addition to the radius. A body inside is hit at time
/// 0, with the shortest way out as normal. `triangle` is the side of the box, 0 to 5, that faces the body.
[[nodiscard]] Impact sweep(const Box& box, double margin, const Body& body, const Vec3& from, const Vec3& motion);

/// The nearest contact of the body with the box during its motion, as in Space::contacts; the margin is subtracted from
/// the distance.
[[nodiscard]] Contact nearest(const Box& box, double margin, const Body& body, const Vec3& from, const Vec3& motion);

/// Number of sides of a box.
inline constexpr TriangleId sides = 6;

}  // namespace roam::unknown
