#pragma once
/// \file
/// The body that recorded a path: a comment of the path file, so that the way can be gone again by the same body.
///
///     # roam: mode walk radius 0.3 height 1.8 eye 1.5 step 0.3 slope 45
///     # roam: mode walk radius 0.3 height 1.8 eye 1.5 step 0.3 slope 45 support 0.65
///     # roam: mode fly
///
/// The first such line says the body, each further one that the mode changed there.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "roam/error.h"
#include "roam/path_file.h"
#include "roam/walker.h"

namespace roam::app {

struct RecordedBody {
  Mode mode = Mode::walk;  ///< walk when all of the way was walked, else fly
  bool ghost = false;      ///< part of the way was gone by a ghost: walls may stand in it
  double radius = 0.3, height = 1.8, eye = 1.6, step = 0.3;  ///< metres
  double slope_degrees = 45.0;
  double support_radius = 0.0;  ///< metres; 0: no foot of its own, and the line does not speak of one
};

/// A further line; the first is body_line() of path_file.h.
[[nodiscard]] std::string mode_line(Mode mode);

/// A path, and the body that recorded it, where the file says it.
struct RecordedPath {
  std::vector<Waypoint> places;
  std::optional<RecordedBody> body;
  std::string problem;  ///< why there are none

  /// The places, once wrong options are refused. Throws roam::Error as load_path does, and naming file and line for a
  /// line that begins like those above and goes on otherwise.
  [[nodiscard]] const std::vector<Waypoint>& waypoints() const {
    if (!problem.empty()) throw Error(problem);
    return places;
  }
};

/// Reads both at once: the file may be a pipe, or `-` for standard input. Empty for no file.
[[nodiscard]] RecordedPath load_recorded_path(const std::filesystem::path& file);

/// A sentence when another body, or in another mode, is sent along the way; empty when it is the same.
[[nodiscard]] std::string compare(const RecordedBody& recorded, const WalkerSettings& settings, Mode mode);

}  // namespace roam::app
