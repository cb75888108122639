#pragma once
/// \file
/// Certified time of impact of a moving body with one triangle.
///
/// A body is a sphere, or a capsule whose axis is vertical. It moves in a straight line: its centre is
/// from + t * motion, t in [0, 1]. Triangles are two-sided and may be degenerate.
///
/// Every answer is backed by a lower bound that does not depend on how well the closest point was computed: for any
/// unit vector n and triangle corners v_i,
///
///     distance(axis at t, triangle) >= min_i n . (centre(t) - v_i) - half_height * |n.z|
///
/// (supporting plane; van den Bergen, "Ray casting against general convex objects", 2004; Mirtich, "Impulse-based
/// dynamic simulation", 1996, for the conservative advance). docs/algorithm.md derives the rounding-error bound that
/// is subtracted from it. Whatever a query reports as free is free in exact arithmetic on the same input; a hit is
/// answered within 1.5e-14 of the reach (radius, half height, motion and distance to the farthest corner, in metres)
/// of the radius. The distance to the scene's origin costs nothing.
///
/// All functions are pure and safe to call from any thread. Input that is not finite or beyond 1e12 m, and a negative
/// radius or half height, throw roam::Error.

#include <cstdint>

#include "roam/error.h"
#include "roam/math.h"
#include "roam/mesh.h"

namespace roam {

/// The collision body: all points within `radius` of a vertical segment of length 2 * half_height about the centre.
/// half_height 0 is the sphere of the paper; radius 0 with half_height 0 is a point, and its sweep is a ray.
struct Body {
  double radius = 0.3;       ///< metres, >= 0
  double half_height = 0.0;  ///< metres, >= 0: half the length of the axis, caps not included

  /// A standing body of whole height `height` (m), caps included. Needs height >= 2 * radius.
  static Body capsule(double radius, double height) { return {radius, 0.5 * height - radius}; }
  /// The whole height, caps included, in metres.
  [[nodiscard]] double height() const { return 2.0 * (radius + half_height); }
};

/// The part of a triangle that is touched.
enum class Feature : std::uint8_t { face, edge, vertex };

/// "face", "edge" or "vertex".
[[nodiscard]] const char* to_string(Feature feature);

/// The answer to a sweep. When `hit` is false only `distance` means anything besides `time`.
struct SweepResult {
  bool hit = false;     ///< the body meets the triangle, or starts touching or inside it
  double time = 1.0;    ///< fraction of the motion that is certified free, rounded down; 0 when it starts in touch
  Vec3 point{0.0};      ///< on the triangle: where it is touched
  Vec3 normal{0.0};     ///< unit vector from `point` towards the body's axis: the way out
  Feature feature = Feature::face;
  /// Certified lower bound, in metres, of the gap between the body's surface and the triangle: at `time` for a hit,
  /// over the whole motion for a miss. Negative exactly when the body starts touching or embedded; moving the body by
  /// -distance along `normal` then frees it from this triangle.
  double distance = 0.0;
};

/// First impact of `body`, moved from `from` by `motion` (metres), with `triangle`.
[[nodiscard]] SweepResult sweep(const Body& body, const Vec3& from, const Vec3& motion, const Triangle& triangle);

/// The closest point of a triangle to a body at rest.
struct Proximity {
  Vec3 point{0.0};   ///< on the triangle
  Vec3 normal{0.0};  ///< unit vector from `point` towards the body's axis; when they meet, the shortest way apart
  Feature feature = Feature::face;
  /// Certified lower bound, in metres, of the signed gap between the body's surface and the triangle; negative when
  /// the body touches or is embedded.
  double distance = 0.0;
};

/// Closest point and certified gap of `body` resting at `place` to `triangle`.
[[nodiscard]] Proximity proximity(const Body& body, const Vec3& place, const Triangle& triangle);

}  // namespace roam
