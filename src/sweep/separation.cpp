#include <algorithm>
#include <cmath>

#include "sweep/certified.h"
#include "sweep/error_bound.h"
#include "sweep/gap_line.h"

namespace roam::certified {

// With any vector n the supporting plane bound of docs/algorithm.md, times |n|, reads: the body is clear of the
// triangle at time t if  min_i n . v_i - t n . m  >  r |n| + h |n_z|,  and the same for -n. It is affine in t, so that
// both ends of the motion decide. It holds for any n, so that the roundings of the cross product do not matter: n is
// what came out. What is left are, in unit roundoffs of |n| times a length: 3 of each |v_i| (dot product) and of |m|,
// one of both (difference), 4 of r (3 of n . n, one half of which the root keeps, the root, the product), one of h, and
// 2 of the right side for its sums. error_bound() charges 16 of each, and the corners' own error. Only where n . n has
// lost digits to underflow is nothing known of |n|.
bool plane_separates(const Body& body, const Vec3& motion, const LocalTriangle& triangle) noexcept {
  const Vec3 n = glm::cross(triangle.corner[1] - triangle.corner[0], triangle.corner[2] - triangle.corner[0]);
  const double squared = glm::dot(n, n);
  if (!(squared > shortest_squared)) return false;
  const auto [least, most] =
      std::minmax({glm::dot(n, triangle.corner[0]), glm::dot(n, triangle.corner[1]), glm::dot(n, triangle.corner[2])});
  const double way = glm::dot(n, motion);
  const double reach = std::sqrt(squared) * (body.radius + error_bound(body, motion, triangle).at(1.0)) +
                       body.half_height * std::abs(n.z);
  return least - std::max(way, 0.0) > reach || std::min(way, 0.0) - most > reach;
}

}  // namespace roam::certified
