#pragma once
/// \file
/// The eye of a body that climbs stairs. It follows the steps smoothly, and stays where the body keeps walls away.

#include "roam/walker.h"

namespace osgRoam {

/// Height of the eye above the body's centre, metres: that of the settings, but at least a quarter of the radius inside
/// the body's surface.
[[nodiscard]] double eye_height(const roam::WalkerSettings& settings, double body_height);

/// The least distance, metres, of any triangle from the eye at eye_height(), standing or crouched.
[[nodiscard]] double least_eye_distance(const roam::WalkerSettings& settings);

class SoftEye {
 public:
  /// The body before a step.
  struct Before {
    double z = 0.0;
    double height = 0.0;  ///< of the body
    bool grounded = false;
  };

  void reset() { lag_ = 0.0; }
  [[nodiscard]] static Before before(const roam::Walker& walker);
  /// Call it after each step of `seconds`.
  void follow(const roam::Walker& walker, const Before& before, double seconds);
  /// Call it after the steps of a frame. It keeps the eye where least_eye_distance() holds.
  void keep_free(const roam::Walker& walker);
  [[nodiscard]] roam::Vec3 eye(const roam::Walker& walker) const;
  [[nodiscard]] bool moving() const { return lag_ != 0.0; }

 private:
  double lag_ = 0.0;  ///< metres that the eye is above its regular position
};

}  // namespace osgRoam
