#pragma once
/// \file
/// Going straight to a place that was pointed at, until there or blocked.

#include <optional>

#include "roam/walker.h"

namespace osgRoam {

class Journey {
 public:
  /// `point` is on a surface with `normal` (unit; towards where one comes from): the body goes to beside it.
  void begin(const roam::Walker& walker, const roam::Vec3& point, const roam::Vec3& normal);
  void end() { under_way_ = false; }
  [[nodiscard]] bool under_way() const { return under_way_; }
  /// The velocity, m/s, for a step of `seconds`: straight there, and no farther. Ends the journey when it is over.
  [[nodiscard]] roam::Vec3 velocity(const roam::Walker& walker, double speed, double seconds);

 private:
  [[nodiscard]] roam::Vec3 way(const roam::Walker& walker) const;

  roam::Vec3 target_{0.0};  ///< of the centre
  bool under_way_ = false;
  double best_ = 0.0;    ///< metres to go when the window of patience began
  double waited_ = 0.0;  ///< seconds since
};

}  // namespace osgRoam
