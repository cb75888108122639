#pragma once
/// \file
/// The profile beside a scene, as `roam walk` and `roam view` take it when nobody says how large the body is.

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

/// For a body whose radius nobody said. None where there is no profile, for a ghost, and where a profile was trained
/// for flying and the body walks. A path that says its body is gone by that body: the profile then counts only where it
/// is of the same one, for the sizes in its regions. Throws roam::Error for a profile that cannot be read, which also
/// says how to do without.
[[nodiscard]] std::optional<SceneProfile> find_scene_profile(const SceneOptions& scene, Mode mode,
                                                             const std::optional<RecordedBody>& recorded);

/// Throws roam::Error when the profile is not of this scene: what, and what to do.
void demand_belongs(const SceneProfile& profile, const SceneIdentity& scene, const std::string& scene_name);

/// That it is used, and for what body: one line.
[[nodiscard]] std::string describe(const SceneProfile& profile);

}  // namespace roam::app
