#pragma once
/// \file
/// Free distances around a body: beside it and above it.

#include <array>

#include "roam/space.h"
#include "roam/walker_settings.h"

namespace roam::measure {

/// A distance to the first obstacle in a direction.
struct Free {
  double distance = 0.0;              ///< m; the reach if nothing was met
  bool bounded = false;               ///< an obstacle was met, and it is known
  TriangleId triangle = no_triangle;  ///< of the obstacle
};

/// Measures with the body itself, made up to 5 mm slimmer so that it does not start in contact. Walking, obstacles
/// beside the body count above the step height only, and no ground that the body can walk up. Thread-safe.
class Room {
 public:
  /// `space` must outlive it. The reach is 12 radii, or `least_reach` (m) if that is more.
  Room(const Space& space, const WalkerSettings& settings, Mode mode, double least_reach = 0.0);

  [[nodiscard]] double reach() const { return reach_; }  ///< m: farthest distance beside the body
  /// From the body's surface along the level unit vector `side`.
  [[nodiscard]] Free beside(const Body& body, const Vec3& centre, const Vec3& side) const;
  /// From the body's lowest point to what is above it, at most five times its height.
  [[nodiscard]] Free headroom(const Body& body, const Vec3& centre) const;
  /// Whether the body can move by its radius along `heading` and against it. In a corner it cannot.
  [[nodiscard]] bool is_passage(const Body& body, const Vec3& centre, const Vec3& heading) const;

 private:
  [[nodiscard]] Free beside_legs_lifted(const Body& body, const Vec3& centre, const Vec3& side) const;
  [[nodiscard]] double step_above(const Body& body, const Vec3& centre) const;  ///< z of what is just a step
  [[nodiscard]] bool is_ground(const Impact& hit, const Vec3& side) const;

  const Space& space_;
  Mode mode_;
  double step_, reach_, least_upright_;
};

/// The triangles at both ends of a measured distance of `width` (m), centred on `point`; the one along the unit vector
/// `direction` last. no_triangle: none is within 2 cm of that end.
[[nodiscard]] std::array<TriangleId, 2> at_ends(const Space& space, const Vec3& point, const Vec3& direction,
                                                double width);

/// In heights of the body: headroom is measured up to here.
inline constexpr double height_reach = 5.0;
/// m: by so much the body is slimmer when its room is measured. More than the 2 mm within which a space reports a hit.
inline constexpr double slimmer = 0.005;

}  // namespace roam::measure
