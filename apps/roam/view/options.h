#pragma once
/// \file
/// The options of `roam view`, and the plan that follows from them and the settings file.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "roam/walker.h"
#include "scenes/body_options.h"
#include "scenes/open_scene.h"
#include "scenes/recorded_body.h"
#include "scenes/scene_options.h"
#include "scenes/scene_profile.h"
#include "view/page_source.h"
#include "view/pose.h"
#include "view/scene_objects.h"
#include "view/section.h"
#include "view/settings.h"

namespace CLI {
class App;
}

namespace roam::app {

/// The options as given on the command line.
struct ViewOptions {
  SceneOptions scene;
  std::filesystem::path store;  ///< empty: search beside the scene
  std::optional<Mode> mode;
  BodyOptions body;
  std::optional<double> speed, fov, picture_scale;
  std::string size = "1280x720";
  bool fullscreen = false;
  std::vector<double> at;      ///< x, y, z, perhaps yaw, perhaps pitch
  std::vector<double> origin;  ///< x, y, z of the scene's zero at the site; empty: as the scene states
  std::string bookmark;
  std::vector<std::string> section;
  std::vector<std::string> hide;  ///< patterns of names
  bool pass_hidden = false;
  std::filesystem::path path;
  double dt = 1.0 / 60.0;
  std::filesystem::path screenshot, record, record_path, trace, settings;
  std::optional<std::string> hud, quality;
  std::optional<double> tile_error;          ///< pixels
  std::optional<std::uint64_t> page_memory;  ///< bytes
  std::optional<double> turntable;           ///< seconds
  std::optional<int> film_rate;              ///< pictures a second
  double time_limit = 0.0;                   ///< seconds after the body's arrival; 0: no limit
  bool headless = false;
  bool verify = false;
  bool json = false;
  bool keys = false;
  bool adapt = false;
  std::filesystem::path program;  ///< roam, for building stores; empty: the running program; no option

  /// Adds all options to a verb.
  void add_to(CLI::App& verb);
};

/// The complete plan of a session, with defaults filled in.
struct ViewPlan {
  WalkerSettings walker;
  std::optional<SceneProfile> profile;  ///< the profile that gives the body its size
  Mode mode = Mode::walk;
  double fov = 65.0;  ///< degrees
  double sensitivity = 1.0;
  bool invert_y = false;
  double easing = 0.15;  ///< seconds; see osgRoam::Manipulator::setEasing
  HudMode hud = HudMode::plain;
  std::string quality = "auto";  ///< one of quality_names
  bool edges = true;
  double picture_scale = 1.0;  ///< of the pictures of the key P, times the window
  SectionShape section;
  SceneObjects::Decisions hidden;  ///< on the same scene, before; make_plan leaves it empty
  PageSettings pages;
  int width = 0, height = 0;   ///< pixels
  int film_rate = 30;          ///< pictures a second
  std::vector<Waypoint> path;  ///< of --path; make_plan leaves it empty
  std::optional<Pose> at;
  std::string note;                ///< a sentence for the person; may be empty
  std::vector<std::string> noted;  ///< in earlier sessions
};

/// The plan for `options` and `settings`.
///
/// The body is that of `roam walk`; see body_of. A path uses the body that `recorded` it, never the sizes of the
/// settings. Unless the options describe a body, a `profile` gives the sizes, whatever the settings say.
///
/// Throws UsageError for contradictory or invalid options, with the settings file's name if the value comes from there.
/// Throws it too for outputs that cannot be written, or would overwrite each other or an input.
[[nodiscard]] ViewPlan make_plan(const ViewOptions& options, const ViewSettings& settings,
                                 const std::optional<RecordedBody>& recorded = std::nullopt,
                                 const std::optional<SceneProfile>& profile = std::nullopt);

}  // namespace roam::app
