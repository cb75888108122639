#pragma once
/// \file
/// A triangle's own plane as the supporting plane of a moving body.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sweep/certified.h"
#include "sweep/error_bound.h"

namespace roam::certified {

/// A lower bound of the gap between body and triangle, times |n|: slack - time * speed, with the error bound
/// subtracted. See docs/algorithm.md, "Supporting plane". It holds for any n, so the roundings of the cross product do
/// not matter.
///
/// The other roundings are, in unit roundoffs of |n| times a length, with one for the product with a time or the
/// quotient of both:
/// - 6 for each |v_i|: 3 in a dot product, 2 differences;
/// - 7.5 for r: the sum, 2.5 in |n| (3 in n . n, of which the root keeps half, and the root), the product, 2
/// differences;
/// - 3 for h, and 5 for |m|.
/// error_bound() charges 16 for each, and adds the corners' own error.
struct FacePlane {
  FacePlane(const Body& body, const Vec3& motion, const LocalTriangle& triangle, const ErrorBound& error) noexcept
      : normal(glm::cross(triangle.corner[1] - triangle.corner[0], triangle.corner[2] - triangle.corner[1])),
        square(glm::dot(normal, normal)),
        length(std::sqrt(square)) {
    const auto [least, most] = std::minmax({glm::dot(normal, triangle.corner[0]), glm::dot(normal, triangle.corner[1]),
                                            glm::dot(normal, triangle.corner[2])});
    const double way = glm::dot(normal, motion);
    // A body that is apart starts on that side of the plane where the gap is positive.
    slack = std::max(least, -most) - length * (body.radius + error.at_start) - body.half_height * std::abs(normal.z);
    speed = (least > -most ? way : -way) + length * error.per_time;
    depth = most - least;
  }

  /// False if n . n has lost digits to underflow: the count does not hold.
  [[nodiscard]] bool is_known() const noexcept { return square > shortest_squared; }

  Vec3 normal;    ///< n, m^2
  double square;  ///< n . n
  double length;  ///< |n|
  double slack;
  double speed;
  double depth;  ///< of the corners along n, times |n|
};

}  // namespace roam::certified
