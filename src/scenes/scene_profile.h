#pragma once
/// \file
/// The profile beside a scene, as `roam walk` and `roam view` use it if the user gives no size of the body.

#include <filesystem>
#include <optional>
#include <string>

#include "roam/profile.h"
#include "scenes/recorded_body.h"
#include "scenes/scene_options.h"

namespace roam::app {

struct SceneProfile {
  std::filesystem::path file;
  Profile profile;
};

/// The profile for a body without a given radius. None if there is no profile, for a ghost, and for a walking body if
/// the profile is for flying. A path with a recorded body uses that body. A profile of the same body then adds its
/// regions; another one does not count. Throws roam::Error for an unreadable profile, with advice how to do without.
[[nodiscard]] std::optional<SceneProfile> find_scene_profile(const SceneOptions& scene, Mode mode,
                                                             const std::optional<RecordedBody>& recorded);

/// Throws roam::Error, with advice, if the profile is not of this scene.
void demand_belongs(const SceneProfile& profile, const SceneIdentity& scene, const std::string& scene_name);

/// One line: that the profile is used, and for what body.
[[nodiscard]] std::string describe(const SceneProfile& profile);

}  // namespace roam::app
