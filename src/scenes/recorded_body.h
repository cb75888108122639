#pragma once
/// \file
/// The body that recorded a path, and the frame of its positions: comments of the path file, so that the same body can
/// repeat the way in the same scene.
///
///     # roam: frame up y unit m
///     # roam: mode walk radius 0.3 height 1.8 eye 1.5 step 0.3 slope 45
///     # roam: mode walk radius 0.3 height 1.8 eye 1.5 step 0.3 slope 45 support 0.65
///     # roam: mode fly
///
/// The first line `mode` describes the body. Each further one marks a change of mode.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "roam/error.h"
#include "roam/path_file.h"
#include "roam/scene_frame.h"
#include "roam/walker.h"
#include "scenes/scene_options.h"

namespace roam::app {

struct RecordedBody {
  Mode mode = Mode::walk;  ///< walk if all of the way was walked, else fly
  bool ghost = false;      ///< a ghost moved along part of the way, so walls may stand in it
  /// Radius, height, eye, step, slope and support disc; the rest has its default.
  WalkerSettings settings{};
};

/// The mode of this name, as of to_string(), if there is one.
[[nodiscard]] std::optional<Mode> mode_named(std::string_view name);

/// A further line; the first is body_line() of path_file.h.
[[nodiscard]] std::string mode_line(Mode mode);

/// The line that states the frame.
[[nodiscard]] std::string frame_line(const SceneFrame& frame);

/// A path, and the body and frame of its recording, if the file states them.
struct RecordedPath {
  std::string name;  ///< of the file, for messages
  std::vector<Waypoint> places;
  std::optional<RecordedBody> body;
  std::optional<SceneFrame> frame;
  std::optional<Error> problem;  ///< why there are no places

  /// The places; call it after invalid options are refused. Throws roam::Error as load_path does. It also throws, with
  /// file and line, for a line that begins like those above but continues differently.
  [[nodiscard]] const std::vector<Waypoint>& waypoints() const {
    if (problem) throw Error(*problem);
    return places;
  }
};

/// Throws roam::Error if the path was recorded in another frame than that of the scene. The message says which options
/// open the path's frame.
void demand_frame(const RecordedPath& path, const std::optional<SceneFrame>& frame, const SceneOptions& scene);

/// Reads all in one pass: the file may be a pipe, or `-` for standard input. Empty if there is no file.
[[nodiscard]] RecordedPath load_recorded_path(const std::filesystem::path& file);

/// A sentence if the way is repeated with another body or in another mode; empty if both are the same.
[[nodiscard]] std::string compare(const RecordedBody& recorded, const WalkerSettings& settings, Mode mode);

}  // namespace roam::app
