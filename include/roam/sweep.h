#pragma once
/// \file
/// Certified time of impact of a moving sphere or upright capsule with one triangle.
///
/// The body's centre is at from + t * motion, t in [0, 1]. Triangles are two-sided and may be degenerate. Lengths are
/// metres. A motion reported free is free in exact arithmetic on the same input: for any unit vector n and corners v_i
///
///     distance(axis at t, triangle) >= min_i n . (centre(t) - v_i) - half_height * |n.z|
///
/// (supporting plane: van den Bergen, "Ray casting against general convex objects", 2004; conservative advance:
/// Mirtich, "Impulse-based dynamic simulation", 1996), minus the rounding error that docs/algorithm.md derives. At a
/// hit the axis is within radius + 1.6e-14 * reach of the triangle. The reach is radius + half height + motion + offset
/// of the farthest corner, the last two as |x| + |y| + |z|; the distance to the scene's origin does not matter.
///
/// All functions are pure and thread-safe. They throw roam::Error for input that is not finite or beyond 1e12 m, and
/// for a negative radius or half height.

#include <cstdint>

#include "roam/error.h"
#include "roam/math.h"
#include "roam/mesh.h"

namespace roam {

/// The collision body: all points within `radius` of a vertical segment of length 2 * half_height about the centre.
/// half_height 0 makes a sphere. If radius is 0 too, it is a point, and its sweep is a ray.
struct Body {
  double radius = 0.3;       ///< >= 0
  double half_height = 0.0;  ///< >= 0: half the length of the axis, without the caps
  /// An upright capsule of the given height, caps included; height >= 2 * radius.
  static Body capsule(double radius, double height) { return {radius, 0.5 * height - radius}; }
  [[nodiscard]] double height() const { return 2.0 * (radius + half_height); }  ///< caps included
};

enum class Feature : std::uint8_t { face, edge, vertex };  ///< the part of a triangle that is touched
[[nodiscard]] const char* to_string(Feature feature);      ///< "face", "edge" or "vertex"

/// The result of a sweep. A miss sets only `time` and `distance`.
struct SweepResult {
  bool hit = false;   ///< the body meets the triangle, or starts touching or overlapping it
  double time = 1.0;  ///< fraction of the motion that is certified free, rounded down; 0 if it starts in touch
  Vec3 point{0.0};    ///< on the triangle; on a sliver farther than the nearest by up to 1e-5 length + 1e-9 radius
  Vec3 normal{0.0};   ///< unit vector from `point` towards the body's axis
  Feature feature = Feature::face;
  /// Certified lower bound of the gap between body and triangle: at `time` for a hit, over the whole motion for a miss.
  /// Negative only if the body starts touching or overlapping: moving it by -distance along `normal` then frees it.
  double distance = 0.0;
};

/// First impact of `body`, moved from `from` by `motion`, with `triangle`.
[[nodiscard]] SweepResult sweep(const Body& body, const Vec3& from, const Vec3& motion, const Triangle& triangle);
/// The first impact up to time `until`, in [0, 1]. A miss has `time` = `until` and `distance` 0, which makes it faster.
[[nodiscard]] SweepResult sweep(const Body& body, const Vec3& from, const Vec3& motion, const Triangle& triangle,
                                double until);

/// The closest point of a triangle to a body at rest.
struct Proximity {
  Vec3 point{0.0};   ///< on the triangle, as of SweepResult
  Vec3 normal{0.0};  ///< unit vector from `point` towards the body's axis; if they meet, the shortest way apart
  Feature feature = Feature::face;
  double distance = 0.0;  ///< certified lower bound of the gap; <= 0 if the body touches or overlaps the triangle
};

/// Closest point and certified gap between `body` at `place` and `triangle`.
[[nodiscard]] Proximity proximity(const Body& body, const Vec3& place, const Triangle& triangle);

}  // namespace roam
