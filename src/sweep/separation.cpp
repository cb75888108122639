#include <algorithm>

#include "sweep/certified.h"
#include "sweep/face_plane.h"
#include "sweep/gap_line.h"

namespace roam::certified {

// The bound is affine in time, so both ends of the motion decide.
bool plane_separates(const Body& body, const Vec3& motion, const LocalTriangle& triangle) noexcept {
  const FacePlane plane(body, motion, triangle, error_bound(body, motion, triangle));
  return plane.is_known() && plane.slack > std::max(plane.speed, 0.0);
}

}  // namespace roam::certified
