#pragma once
/// \file
/// Points, boxes and the two conventions everything else relies on.
///
/// Lengths are metres and angles are radians unless a name says otherwise. The up axis is +z. Positions are doubles
/// in the scene's own frame: nothing in roam shifts or rotates what a caller passes, and import.h says what it does to
/// files.

#include <glm/vec3.hpp>

#include <limits>

namespace roam {

/// A point or a displacement, in metres.
using Vec3 = glm::dvec3;

/// An axis-aligned box. A default-constructed box is empty and grows from nothing; the size and centre of an empty box
/// mean nothing.
struct Box {
  Vec3 lower{std::numeric_limits<double>::infinity()};
  Vec3 upper{-std::numeric_limits<double>::infinity()};

  [[nodiscard]] bool empty() const { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }
  [[nodiscard]] Vec3 size() const { return upper - lower; }
  [[nodiscard]] Vec3 center() const { return 0.5 * lower + 0.5 * upper; }

  /// Whether a point lies in it or on its border; false for a point that is not a number.
  [[nodiscard]] bool holds(const Vec3& p) const {
    return p.x >= lower.x && p.x <= upper.x && p.y >= lower.y && p.y <= upper.y && p.z >= lower.z && p.z <= upper.z;
  }
  /// Larger on both sides by so many metres along each axis.
  [[nodiscard]] Box grown(const Vec3& by) const { return {lower - by, upper + by}; }
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
