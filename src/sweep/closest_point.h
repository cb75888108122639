#pragma once
/// \file
/// Closest points of a triangle and a body's axis. The direction between them is made perpendicular to the feature, so
/// that it can be the normal of a supporting plane.

#include "sweep/support_plane.h"

namespace roam::certified {

/// A pair of closest points.
struct Closest {
  Vec3 away;            ///< from the triangle towards the axis; perpendicular to the edge or face; any length
  double away_squared;  ///< |away|^2
  double squared;       ///< m^2: squared distance of two real points of triangle and axis, so never less than the
                        ///< minimum
  Vec3 point;           ///< on the triangle
  Feature feature;
  Vec3 straight{0.0};  ///< the edge or axis along which the closest points may slide; zero if neither, or both
};

/// Closest point of the triangle to a point.
[[nodiscard]] Closest closest_to_point(Obstacle& obstacle, const Vec3& p) noexcept;

/// Closest points of the triangle and the vertical axis about `centre`. An axis that pierces the face has no such pair:
/// the result is then the best pair of its ends and the edges, and no plane confirms it.
[[nodiscard]] Closest closest_to_axis(Obstacle& obstacle, const Vec3& centre) noexcept;

/// The component of `x` perpendicular to the edge, to working precision relative to its own length.
[[nodiscard]] Vec3 perpendicular_to_edge(const Obstacle& obstacle, int edge, const Vec3& x) noexcept;

}  // namespace roam::certified
