#pragma once
/// \file
/// The supporting plane that best separates a body's axis from a triangle.

#include <glm/geometric.hpp>

#include "roam/sweep.h"

namespace roam::certified {

/// The triangle and the half height of the body's axis: all that stays the same while the body moves.
class Obstacle {
 public:
  Obstacle(const Vec3 (&corners)[3], double half_height_m) noexcept;

  Vec3 corner[3];
  Vec3 edge[3];            ///< edge[i] runs from corner i to corner i + 1
  double edge_squared[3];  ///< m^2
  double half_height;      ///< m, of the body's vertical axis

  /// Index of the longest edge.
  [[nodiscard]] int longest_edge() const noexcept;
  /// Unit vector, perpendicular to the longest edge; zero for a triangle that is a segment or a point.
  [[nodiscard]] const Vec3& face_normal() noexcept {
    if (!face_normal_known_) find_face_normal();
    return face_normal_;
  }

 private:
  void find_face_normal() noexcept;

  bool face_normal_known_ = false;
  Vec3 face_normal_;
};

/// A unit normal, and the signed distance of the body's axis along it: normal . centre + offset.
struct SupportPlane {
  Vec3 normal;
  double offset;  ///< metres: -max_i normal . corner_i - half_height * |normal.z|
  Vec3 point;     ///< on the triangle: the closest point, or the last one left when the axis meets the triangle
  Feature feature;
  Vec3 straight;  ///< motion along it does not change the distance: the closest edge, or the axis, or zero

  [[nodiscard]] double value(const Vec3& centre) const { return glm::dot(normal, centre) + offset; }
};

/// The plane of greatest value for a body at `centre`. Its value is the signed distance of axis and triangle, less at
/// most about `slack` (metres) for rounding. Every plane returned is a valid bound; `slack` only decides when more work
/// is spent on a better one.
[[nodiscard]] SupportPlane support_plane(Obstacle& obstacle, const Vec3& centre, double slack) noexcept;

}  // namespace roam::certified
