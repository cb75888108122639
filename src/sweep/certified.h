#pragma once
/// \file
/// The certified sweep in local coordinates: what the public functions and the world both call for one triangle.
///
/// The frame's origin is the start of the motion, so that no digits are lost to a far origin. Every function is pure,
/// allocates nothing and needs finite input with lengths up to length_limit; nothing is checked here.

#include "roam/sweep.h"

namespace roam::certified {

/// Metres. Squares of squares of lengths stay finite well beyond it.
inline constexpr double length_limit = 1e12;

/// A triangle seen from the start of the motion.
struct LocalTriangle {
  Vec3 corner[3];             ///< metres, relative to the start of the motion
  double corner_error = 0.0;  ///< metres: every coordinate is at most so far from the truth
};

/// First impact between t_begin, up to which the motion is already known to be free, and t_end; both in [0, 1].
///
/// `body.radius` is what is kept free, any inflation included. A hit is answered once the certified gap is
/// <= hit_tolerance less the error bounds, so that the true distance at `time` is <= radius + hit_tolerance, or once
/// rounding errors allow no further advance: within radius + hit_resolution(). 0 goes as close as they allow.
/// `distance` of a hit is >= 0, but negative for a body that touches or is embedded when t_begin is 0. Of a miss it
/// is a bound that costs nothing and may be 0; approach() gives a tight one.
[[nodiscard]] SweepResult sweep(const Body& body, const Vec3& motion, const LocalTriangle& triangle, double t_begin,
                                double t_end, double hit_tolerance) noexcept;

/// Whether the triangle's own plane shows that the body is clear of it on the whole motion: a sweep would miss.
/// False says nothing.
[[nodiscard]] bool plane_separates(const Body& body, const Vec3& motion, const LocalTriangle& triangle) noexcept;

/// Closest point and certified signed gap of `body` resting at the frame's origin.
[[nodiscard]] Proximity proximity(const Body& body, const LocalTriangle& triangle) noexcept;

/// Where a moving body comes closest to a triangle.
struct Approach {
  double time = 0.0;    ///< in [t_begin, t_end]: a time of least gap
  Proximity proximity;  ///< measured at `time`; but `distance` is a certified lower bound over [t_begin, t_end]
};

/// The least signed gap over [t_begin, t_end]. `distance` is tight to approach_tolerance of the clearance, or to the
/// error bound where that is more.
[[nodiscard]] Approach approach(const Body& body, const Vec3& motion, const LocalTriangle& triangle, double t_begin,
                                double t_end) noexcept;

/// Relative. How tight the answer of approach() is.
inline constexpr double approach_tolerance = 1e-10;

/// Metres. How far from the radius a hit of tolerance 0 may be, beyond the triangle's own corner_error: the error
/// bound at t_end times hit_factor.
[[nodiscard]] double hit_resolution(const Body& body, const Vec3& motion, const LocalTriangle& triangle,
                                    double t_end) noexcept;

}  // namespace roam::certified
