#pragma once
/// \file
/// Equations (1) to (6) of Xie and Niu (2020), "A 3D roaming and collision detection algorithm applicable for massive
/// spatial data", PLoS ONE 15(2): e0229038, as printed, in doubles: the baseline that tests and benchmarks compare
/// with. No part of the library.
///
/// Read literally: space is divided by the radius, so that the sphere has radius 1; the plane counts from t0 to t1 of
/// equation (4), so that faces are met from the side of their normal only. Three things had to be chosen where the
/// paper is silent: t0 is clamped to 0 for a sphere that starts within the plane's reach; the quadratics for edge and
/// vertex, which it does not print, are |C(t) - closest point| = 1 solved for the first root; and f0 of equation (6)
/// runs over [-1, 0], as it must with e1 = p1 - p2. Divisions by zero are left to the floating-point standard.

#include <optional>

#include "roam/mesh.h"
#include "roam/sweep.h"

namespace paper {

/// What the paper's method answers for one triangle.
struct Collision {
  double time;       ///< t of equation (1), in [0, 1]
  roam::Vec3 point;  ///< of contact, metres
  roam::Feature feature;
};

/// The test of fig. 5: all corners lie beyond one side of the box that the sphere sweeps. Metres.
[[nodiscard]] bool beyond_box(double radius, const roam::Vec3& from, const roam::Vec3& motion,
                              const roam::Triangle& triangle);

/// Steps 5 and 6 of fig. 4 for one triangle: equations (1) to (6). Metres; radius > 0.
[[nodiscard]] std::optional<Collision> collide(double radius, const roam::Vec3& from, const roam::Vec3& motion,
                                               const roam::Triangle& triangle);

}  // namespace paper
