#pragma once
/// \file
/// The body that recorded a path: a comment of the path file, so that the same body can repeat the way.
///
///     # roam: mode walk radius 0.3 height 1.8 eye 1.5 step 0.3 slope 45
///     # roam: mode walk radius 0.3 height 1.8 eye 1.5 step 0.3 slope 45 support 0.65
///     # roam: mode fly
///
/// The first such line describes the body. Each further one marks a change of mode.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "roam/error.h"
#include "roam/path_file.h"
#include "roam/walker.h"

namespace roam::app {

/// Of the settings, the line has the sizes, the step, the slope and the support disc.
struct RecordedBody : WalkerSettings {
  Mode mode = Mode::walk;  ///< walk if all of the way was walked, else fly
  bool ghost = false;      ///< a ghost moved along part of the way, so walls may stand in it
};

/// A further line; the first is body_line() of path_file.h.
[[nodiscard]] std::string mode_line(Mode mode);

/// A path, and the body that recorded it, if the file has one.
struct RecordedPath {
  std::vector<Waypoint> places;
  std::optional<RecordedBody> body;
  std::string problem;  ///< why there are no places

  /// The places; call it after invalid options are refused. Throws roam::Error as load_path does. It also throws, with
  /// file and line, for a line that begins like those above but continues differently.
  [[nodiscard]] const std::vector<Waypoint>& waypoints() const {
    if (!problem.empty()) throw Error(problem);
    return places;
  }
};

/// Reads both in one pass: the file may be a pipe, or `-` for standard input. Empty if there is no file.
[[nodiscard]] RecordedPath load_recorded_path(const std::filesystem::path& file);

/// A sentence if the way is repeated with another body or in another mode; empty if both are the same.
[[nodiscard]] std::string compare(const RecordedBody& recorded, const WalkerSettings& settings, Mode mode);

}  // namespace roam::app
