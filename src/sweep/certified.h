#pragma once
/// \file
/// The certified sweep of one triangle in local coordinates, called by the public functions and by the world.
///
/// The frame's origin is the start of the motion, so that no digits are lost to a far origin. Every function is pure
/// and allocates nothing. Input must be finite with lengths up to length_limit; nothing is checked here.

#include "roam/sweep.h"

namespace roam::certified {

/// Metres. Fourth powers of lengths stay finite well beyond it.
inline constexpr double length_limit = 1e12;

/// A triangle seen from the start of the motion.
struct LocalTriangle {
  Vec3 corner[3];             ///< metres, relative to the start of the motion
  double corner_error = 0.0;  ///< metres: greatest error of each coordinate
};

/// First impact between t_begin and t_end, both in [0, 1]; the motion up to t_begin must be known to be free.
///
/// `body.radius` includes any inflation. A hit is returned once the certified gap is <= hit_tolerance less the error
/// bounds, so that the true distance at `time` is <= radius + hit_tolerance. It is also returned once rounding errors
/// allow no further advance; then the distance is within radius + hit_factor times the error bound at t_end (see
/// error_bound.h). A hit_tolerance of 0 goes as close as rounding allows. The `distance` of a hit is >= 0, except for a
/// body that touches or overlaps when t_begin is 0: then it is <= 0. The `distance` of a miss is a lower bound that
/// costs nothing and may be 0; approach() gives a tight one.
[[nodiscard]] SweepResult sweep(const Body& body, const Vec3& motion, const LocalTriangle& triangle, double t_begin,
                                double t_end, double hit_tolerance) noexcept;

/// The time of such a hit of a sphere (half height 0), or t_end for a miss. Faster than sweep() where the centre runs
/// onto the inside of the face.
[[nodiscard]] double sphere_impact_time(const Body& body, const Vec3& motion, const LocalTriangle& triangle,
                                        double t_begin, double t_end, double hit_tolerance) noexcept;

/// True if the triangle's own plane proves that the body is clear of the triangle during the whole motion: a sweep
/// would miss. False proves nothing.
[[nodiscard]] bool plane_separates(const Body& body, const Vec3& motion, const LocalTriangle& triangle) noexcept;

/// Closest point and certified signed gap of `body` resting at the frame's origin.
[[nodiscard]] Proximity proximity(const Body& body, const LocalTriangle& triangle) noexcept;

/// The closest approach of a moving body to a triangle.
struct Approach {
  double time = 0.0;    ///< in [t_begin, t_end]: a time of least gap
  Proximity proximity;  ///< measured at `time`, except `distance`: a certified lower bound over [t_begin, t_end]
};

/// The least signed gap over [t_begin, t_end]. `distance` is tight to approach_tolerance of the distance between axis
/// and triangle, or to the error bound if that is larger.
[[nodiscard]] Approach approach(const Body& body, const Vec3& motion, const LocalTriangle& triangle, double t_begin,
                                double t_end) noexcept;

/// Relative tightness of the result of approach().
inline constexpr double approach_tolerance = 1e-10;

}  // namespace roam::certified
