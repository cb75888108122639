#pragma once
/// \file
/// The options of `roam view`, and what follows from them and the settings file.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "roam/walker.h"
#include "scenes/open_scene.h"
#include "scenes/recorded_body.h"
#include "scenes/scene_options.h"
#include "scenes/scene_profile.h"
#include "view/pose.h"
#include "view/settings.h"

namespace CLI {
class App;
}

namespace roam::app {

/// As they stand on the command line.
struct ViewOptions {
  SceneOptions scene;
  std::filesystem::path store;  ///< empty: look beside the scene
  std::optional<std::string> mode;
  std::optional<double> radius, height, eye, step, slope, speed, fov;
  std::string size = "1280x720";
  bool fullscreen = false;
  std::vector<double> at;  ///< x, y, z, perhaps yaw, perhaps pitch
  std::string bookmark;
  std::filesystem::path path;
  double dt = 1.0 / 60.0;
  std::filesystem::path screenshot, record, record_path, trace, settings;
  std::optional<std::string> hud;
  double time_limit = 0.0;  ///< seconds after the start place is taken; 0: until somebody ends it
  bool headless = false;
  bool verify = false;
  bool json = false;
  bool keys = false;
  bool no_profile = false;
  bool adapt = false;
  std::filesystem::path program;  ///< no option: roam, which builds stores; empty: the running program

  /// Adds all of them to a verb.
  void add_to(CLI::App& verb);
};

/// What a session is to do: nothing that was left out is left open.
struct ViewPlan {
  WalkerSettings walker;
  std::optional<SceneProfile> profile;  ///< that the body is taken from
  Mode mode = Mode::walk;
  double fov = 65.0;  ///< degrees
  double sensitivity = 1.0;
  bool invert_y = false;
  HudMode hud = HudMode::full;
  int width = 0, height = 0;   ///< pixels
  std::vector<Waypoint> path;  ///< of --path, which make_plan does not read
  std::optional<Pose> at;
  std::string note;  ///< what the person should know of it; or empty
};

/// A body that nobody described is a grown person (WalkerSettings); of one that was, as of `roam walk`, the height
/// follows from the radius. A path is replayed by the body that `recorded` it, else by that of `roam walk`, described
/// or not. A `profile` says the body where no radius is on the command line, whatever the settings file says. Throws
/// UsageError for what cannot be meant, naming the settings file where a value comes from there, and for outputs that
/// cannot be written or would overwrite each other or what is read.
[[nodiscard]] ViewPlan make_plan(const ViewOptions& options, const ViewSettings& settings,
                                 const std::optional<RecordedBody>& recorded = std::nullopt,
                                 const std::optional<SceneProfile>& profile = std::nullopt);

}  // namespace roam::app
