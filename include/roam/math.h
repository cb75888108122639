#pragma once
/// \file
/// Points and boxes; units and axes.
///
/// Lengths are metres, angles radians unless a name says otherwise; +z is up. Positions are doubles in the scene's own
/// frame. roam neither shifts nor rotates them; import.h describes the frames of files.

#include <glm/vec3.hpp>

#include <limits>

namespace roam {

using Vec3 = glm::dvec3;  ///< a point or a displacement

/// An axis-aligned box. Empty by default; include() extends it. An empty box has no meaningful size or centre.
struct Box {
  Vec3 lower{std::numeric_limits<double>::infinity()};
  Vec3 upper{-std::numeric_limits<double>::infinity()};
  [[nodiscard]] bool empty() const { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }
  [[nodiscard]] Vec3 size() const { return upper - lower; }
  [[nodiscard]] Vec3 center() const { return 0.5 * lower + 0.5 * upper; }

  /// Whether `p` lies inside or on the border; false for NaN.
  [[nodiscard]] bool holds(const Vec3& p) const {
    return p.x >= lower.x && p.x <= upper.x && p.y >= lower.y && p.y <= upper.y && p.z >= lower.z && p.z <= upper.z;
  }
  [[nodiscard]] Box grown(const Vec3& by) const { return {lower - by, upper + by}; }  ///< by so much on each side
  [[nodiscard]] Box grown(double by) const { return grown(Vec3(by)); }
  void include(const Vec3& p) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = p[k] < lower[k] ? p[k] : lower[k];
      upper[k] = p[k] > upper[k] ? p[k] : upper[k];
    }
  }
  void include(const Box& b) {
    if (b.empty()) return;
    include(b.lower);
    include(b.upper);
  }
};

}  // namespace roam
