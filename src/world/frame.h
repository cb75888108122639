#pragma once
/// \file
/// The frame of an instance, and queries in it.

#include "roam/instances.h"
#include "roam/space.h"

namespace roam::query {

/// In the number of an instance's triangle: the bits that count in its world, and the bit that all of them have.
inline constexpr TriangleId source_bits = 0xFFFFFFFF;
inline constexpr TriangleId instance_bit = TriangleId{1} << 62;
/// Whether a triangle belongs to an instance. In a Pager the bit above it marks unknown space.
[[nodiscard]] constexpr bool is_of_instance(TriangleId triangle) { return triangle >> 62 == 1; }

/// The pose of an instance as queries use it.
struct Frame {
  Vec3 position;         ///< metres
  double cosine, sine;   ///< of the heading
  TriangleId triangles;  ///< number of triangle 0 of its world
  ObjectId object;
  double pad = 0.0;  ///< metres: the rounding of a query may move the body by this

  [[nodiscard]] Vec3 to_scene_way(const Vec3& v) const {
    return {cosine * v.x - sine * v.y, sine * v.x + cosine * v.y, v.z};
  }
  [[nodiscard]] Vec3 to_instance_way(const Vec3& v) const {
    return {cosine * v.x + sine * v.y, cosine * v.y - sine * v.x, v.z};
  }
  [[nodiscard]] Vec3 to_scene(const Vec3& p) const { return position + to_scene_way(p); }
  [[nodiscard]] Vec3 to_instance(const Vec3& p) const { return to_instance_way(p - position); }

  [[nodiscard]] Contact in_scene(const Contact& c) const {
    Contact seen = c;
    seen.point = to_scene(c.point);
    seen.normal = to_scene_way(c.normal);
    seen.triangle = triangles | (c.triangle & source_bits);
    seen.object = object;
    return seen;
  }
};

}  // namespace roam::query
