#pragma once
/// \file
/// Straight motion to a target until the body arrives or is blocked.

#include <optional>

#include "roam/walker.h"

namespace osgRoam {

class Journey {
 public:
  /// `point` is on a surface with the unit `normal` towards the viewer. The body goes beside that surface.
  void begin(const roam::Walker& walker, const roam::Vec3& point, const roam::Vec3& normal);
  void end() { under_way_ = false; }
  [[nodiscard]] bool under_way() const { return under_way_; }
  /// The velocity, m/s, for a step of `seconds`: straight to the target, and no farther. Ends the journey on arrival or
  /// when blocked.
  [[nodiscard]] roam::Vec3 velocity(const roam::Walker& walker, double speed, double seconds);

 private:
  [[nodiscard]] roam::Vec3 way(const roam::Walker& walker) const;

  roam::Vec3 target_{0.0};  ///< of the body's centre
  bool under_way_ = false;
  double best_ = 0.0;    ///< metres to go at the start of the present interval of patience
  double waited_ = 0.0;  ///< seconds since then
};

}  // namespace osgRoam
