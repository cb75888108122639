#include <algorithm>
#include <cmath>

#include "sweep/certified.h"
#include "sweep/error_bound.h"
#include "sweep/gap_line.h"

namespace roam::certified {

// Let n be any vector. The supporting plane bound of docs/algorithm.md, times |n|, then says that the body is clear of
// the triangle at time t if  min_i n . v_i - t n . m  >  r |n| + h |n_z|,  and the same for -n. It is affine in t, so
// that both ends of the motion decide. It holds for any n, so that the roundings of the cross product do not matter.
//
// The other roundings are, in unit roundoffs of |n| times a length:
// - 3 for each |v_i| and for |m| (dot products), and one for each of them (difference);
// - 4 for r (3 in n . n, of which the root keeps half, the root, the product);
// - one for h, and 2 for the sums of the right side.
// error_bound() charges 16 for each, and adds the corners' own error. The count fails only where n . n has lost digits
// to underflow.
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
