#pragma once
/// \file
/// Replay of a path file by body and eye: `roam view --path`.

#include <optional>
#include <vector>

#include "osgRoam/Manipulator.h"
#include "roam/path_file.h"
#include "roam/route.h"
#include "view/view_report.h"

namespace roam::app {

/// A walk along waypoints, identical to that of `roam walk` with the same options.
class Replay {
 public:
  Replay(Walker& walker, const std::vector<Waypoint>& path, const RouteOptions& options);

  /// Attaches the manipulator's body. Its eye follows when look() is called in each frame.
  void lead(osgRoam::Manipulator& roamer);
  void look(osgRoam::Manipulator& roamer, double seconds);

  /// Performs one step. Returns its report, or null after the end of the path, or where it was left.
  const StepReport* advance();
  [[nodiscard]] bool done() const { return route_.done() || left_; }
  /// Whether the path has ended by itself; result() has its outcome.
  [[nodiscard]] bool ended() const { return route_.done(); }
  [[nodiscard]] const RouteResult& result() const { return route_.result(); }
  /// Whether the person has changed the mode or put the body elsewhere, which ends the replay.
  [[nodiscard]] bool left() const { return left_; }
  /// Makes the way go on from where the body was put.
  void go_on_here() { place_ = walker_->position(); }

  /// The velocity towards the next waypoint, m/s. Its length is approximate.
  [[nodiscard]] Vec3 wish() const;

  /// Direction of the eye, radians: as recorded, else smoothly along the path ahead. `seconds`: since the last call.
  struct Gaze {
    double yaw = 0.0;
    double pitch = 0.0;
  };
  Gaze gaze(double seconds);

  void fill(ViewReport& report) const;

 private:
  [[nodiscard]] Vec3 recorded_direction() const;
  [[nodiscard]] Vec3 direction_ahead() const;

  Walker* walker_;
  std::vector<Waypoint> path_;
  Route route_;
  double speed_;
  Mode mode_;
  Vec3 place_;  ///< of the body after the last step
  bool left_ = false;
  std::optional<Vec3> direction_;  ///< unit vector of the gaze
};

}  // namespace roam::app
