#pragma once
/// \file
/// Part of an instance's movement, and the response of a body to it.

#include "roam/instances.h"

namespace roam::walking {

/// A movement short enough for a body to see it as straight.
struct InstanceMotion {
  ObjectId instance = no_object;
  const World* world = nullptr;
  Pose from, to;
  double begin = 0.0, seconds = 0.0;  ///< since move_instances() began, and the duration

  /// The position of a point that moves with the instance.
  [[nodiscard]] Vec3 carried(const Vec3& point) const { return to.to_scene(from.to_instance(point)); }
  /// A direction that turns with the instance.
  [[nodiscard]] Vec3 turned(const Vec3& direction) const;
  /// Metres. Upper bound of the distance between the path of a point and the path's chord. As the instance sees it, the
  /// point moves by `way` meanwhile. The bound is an eighth of the greatest second derivative of R(-angle t) (point +
  /// way t - position - shift t) for t in [0, 1].
  [[nodiscard]] double bulge(const Vec3& point, const Vec3& way) const;
};

/// The response of a body to the movement.
struct Response {
  Vec3 way{0.0};           ///< metres
  double clearance = 0.0;  ///< metres, certified over the way: to everything; for a body at rest, to the instance alone
  double rested = 0.0;     ///< certified at the position, if the body rested there while the instance moved before
};

}  // namespace roam::walking
