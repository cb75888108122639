#pragma once
/// \file
/// Leads the body along a path file, and the eye with it: `roam view --path`.

#include <optional>
#include <vector>

#include "osgRoam/Manipulator.h"
#include "roam/path_file.h"
#include "roam/route.h"
#include "view/view_report.h"

namespace roam::app {

/// A walk along waypoints, exactly that of `roam walk` with the same options.
class Replay {
 public:
  Replay(Walker& walker, const std::vector<Waypoint>& path, const RouteOptions& options);

  /// From now on leads the manipulator's body, and its eye when look() is called in each frame.
  void lead(osgRoam::Manipulator& roamer);
  void look(osgRoam::Manipulator& roamer, double seconds);

  /// One step; its report, or null when the path has come to its end before.
  const StepReport* advance();
  [[nodiscard]] bool done() const { return route_.done() || left_; }
  /// The path has come to an end of its own: result() says to which.
  [[nodiscard]] bool ended() const { return route_.done(); }
  [[nodiscard]] const RouteResult& result() const { return route_.result(); }
  /// The person has changed the mode: the rest of the path is not gone.
  [[nodiscard]] bool left() const { return left_; }

  /// The velocity towards the next waypoint, m/s; its length is only roughly right.
  [[nodiscard]] Vec3 wish() const;

  /// Where to look, radians: as the path was recorded, else along the way ahead. Turns softly; `seconds` since last
  /// asked.
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
  bool left_ = false;
  std::optional<Vec3> direction_;  ///< unit, of the gaze
};

}  // namespace roam::app
