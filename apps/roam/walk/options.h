#pragma once
/// \file
/// The options of `roam walk`, and the body that follows from them.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "roam/route.h"
#include "scenes/body_options.h"
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
  std::vector<double> from;      ///< start of wandering: x, y, z; or empty
  std::optional<Mode> mode;
  BodyOptions body;
  WalkerSettings settings;               ///< see walker_settings()
  std::optional<RecordedBody> recorded;  ///< the body that recorded the path
  std::optional<SceneProfile> profile;   ///< the profile that gives the body its size
  RouteOptions route;
  std::filesystem::path trace;
  std::filesystem::path picture;
  std::filesystem::path certify;
  bool verify = false;
  SceneOptions against;  ///< scene of a store, for verification
  bool json = false;
  bool stats = false;

  /// Whether every move is verified.
  [[nodiscard]] bool checks() const { return verify || !against.scenes.empty(); }
  /// Whether every move is recorded, to be verified or certified.
  [[nodiscard]] bool keeps_moves() const { return checks() || !certify.empty(); }
  [[nodiscard]] Mode walker_mode() const { return mode.value_or(recorded ? recorded->mode : Mode::walk); }

  /// Adds all options to the verb.
  void add_to(CLI::App& verb);
};

/// Finds the scene's profile, unless the options describe a body; see find_scene_profile.
void take_profile(WalkOptions& options);

/// The settings that the options stand for; see body_of. Throws UsageError for invalid ones.
[[nodiscard]] WalkerSettings walker_settings(const WalkOptions& options);

/// Metres.
[[nodiscard]] double path_length(std::span<const Vec3> points);

/// Metres around the body of this walk that its next steps, measurements and looks around can query.
[[nodiscard]] double reach_of_steps(const WalkOptions& options, const Space& space);

/// Throws UsageError if the options name no path to follow.
void check_way(const WalkOptions& options);

/// Throws UsageError for outputs that would overwrite an input or each other, and for unknown kinds of picture.
void check_outputs(const WalkOptions& options);

}  // namespace roam::app
