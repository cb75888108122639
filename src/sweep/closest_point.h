#pragma once
/// \file
/// The closest points of a triangle and of a body's axis, with the direction between them made perpendicular to the
/// feature, so that it serves as the normal of a supporting plane.

#include "sweep/support_plane.h"

namespace roam::certified {

/// A pair of closest points.
struct Closest {
  Vec3 away;            ///< from the triangle towards the axis; perpendicular to the edge or face; any length
  double away_squared;  ///< |away|^2
  double squared;       ///< squared distance of two real points of triangle and axis, m^2: never less than the least
  Vec3 point;           ///< on the triangle
  Feature feature;
  Vec3 straight{0.0};  ///< the edge or axis along which the closest points may slide; zero if neither, or both
};

/// Closest point of the triangle to a point.
[[nodiscard]] Closest closest_to_point(Obstacle& obstacle, const Vec3& p) noexcept;

/// Closest points of the triangle and the vertical axis about `centre`. An axis that pierces the face has none: then
/// the answer is the best that its ends and the edges offer, and no plane can confirm it.
[[nodiscard]] Closest closest_to_axis(Obstacle& obstacle, const Vec3& centre) noexcept;

/// The part of `x` that is perpendicular to the edge, to working precision relative to itself.
[[nodiscard]] Vec3 perpendicular_to_edge(const Obstacle& obstacle, int edge, const Vec3& x) noexcept;

}  // namespace roam::certified
