#pragma once
/// \file
/// The options of `roam walk`, and the body that they mean.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "roam/route.h"
#include "scenes/open_scene.h"
#include "scenes/recorded_body.h"
#include "scenes/scene_profile.h"

namespace CLI {
class App;
}

namespace roam::app {

struct WalkOptions {
  SceneOptions scene;
  std::filesystem::path path;
  std::optional<double> wander;  ///< seconds
  std::vector<double> from;      ///< where wandering starts: x, y, z, or nothing
  std::optional<std::string> mode;
  WalkerSettings settings;
  std::optional<double> radius, support_radius, height, eye, step, slope;
  std::optional<RecordedBody> recorded;  ///< that the path was recorded with
  bool no_profile = false;
  std::optional<SceneProfile> profile;  ///< that the body is taken from
  RouteOptions route;
  std::filesystem::path trace;
  std::filesystem::path picture;
  bool verify = false;
  SceneOptions against;  ///< the scene that a store was made of
  bool json = false;
  bool stats = false;

  /// Whether every move is checked against triangles.
  [[nodiscard]] bool checks() const { return verify || !against.scenes.empty(); }
  [[nodiscard]] Mode walker_mode() const {
    if (!mode) return recorded ? recorded->mode : Mode::walk;
    return *mode == "fly" ? Mode::fly : *mode == "ghost" ? Mode::ghost : Mode::walk;
  }

  /// Adds all of them to the verb.
  void add_to(CLI::App& verb);
};

/// Looks for the scene's profile where the radius is left out: see find_scene_profile.
void take_profile(WalkOptions& options);

/// The options as they are meant: where the radius is left out, the body that recorded the path or that was trained for
/// the scene, with what else is said changed; the height that follows from the radius, the eye that follows from the
/// height. Throws UsageError for what cannot be.
[[nodiscard]] WalkerSettings walker_settings(const WalkOptions& options);

/// Throws UsageError if the options name no way.
void check_way(const WalkOptions& options);

/// Throws UsageError for outputs that would overwrite what is read, or each other, and for what is no picture.
void check_outputs(const WalkOptions& options);

}  // namespace roam::app
