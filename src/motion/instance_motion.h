#pragma once
/// \file
/// A part of an instance's movement, and where a body goes meanwhile.

#include "roam/instances.h"

namespace roam::walking {

/// The movement is so short that a body sees it as straight.
struct InstanceMotion {
  ObjectId instance = no_object;
  const World* world = nullptr;
  Pose from, to;
  double begin = 0.0, seconds = 0.0;  ///< since move_instances() began, and how long it takes

  /// Where the instance takes a point with it.
  [[nodiscard]] Vec3 carried(const Vec3& point) const { return to.to_scene(from.to_instance(point)); }
  /// What becomes of a direction that turns with the instance.
  [[nodiscard]] Vec3 turned(const Vec3& direction) const;
  /// How far the way of a point that goes by `way` meanwhile, as the instance sees it, leaves its chord, metres at
  /// most: an eighth of the greatest second derivative of R(-angle t) (point + way t - position - shift t) for t in [0,
  /// 1].
  [[nodiscard]] double bulge(const Vec3& point, const Vec3& way) const;
};

/// How a body responds to it.
struct Response {
  Vec3 way{0.0};           ///< metres
  double clearance = 0.0;  ///< certified over the way, of everything, metres; of a rest, of the instance alone
  double rested = 0.0;     ///< certified of the place, where the body rested there while the instance moved before
};

}  // namespace roam::walking
