#include "scenes/scene_profile.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/tell.h"
#include "words/measures.h"

namespace roam::app {

std::optional<SceneProfile> find_scene_profile(const SceneOptions& scene, Mode mode,
                                               const std::optional<RecordedBody>& recorded) {
  if (mode == Mode::ghost) return std::nullopt;
  // The readers refuse a scene without a name.
  if (std::any_of(scene.scenes.begin(), scene.scenes.end(), [](const auto& file) { return file.empty(); }))
    return std::nullopt;
  const std::filesystem::path file = profile_path(scene.scenes);
  std::optional<Profile> profile;
  try {
    profile = find_profile(scene.scenes);
  } catch (const Error& error) {
    throw Error::at(error.where(), std::string(error.what()) + "; --no-profile does without it");
  }
  if (!profile) return std::nullopt;
  if (profile->mode == Mode::fly && mode == Mode::walk) {
    tell(fmt::format("note: {} was trained for flying: it is not used on foot", file.string()));
    return std::nullopt;
  }
  if (recorded) {
    const WalkerSettings& body = recorded->settings;
    const bool same = body.radius == profile->radius && body.height == profile->height && body.step == profile->step &&
                      body.slope_degrees == profile->slope_degrees && body.support_radius == profile->support_radius;
    if (!same) return std::nullopt;
  }
  return SceneProfile{file, std::move(*profile)};
}

void demand_belongs(const SceneProfile& profile, const SceneIdentity& scene, const std::string& scene_name) {
  if (profile.profile.belongs_to(scene)) return;
  throw Error::at(
      profile.file.string(),
      fmt::format("{} is not of {}: it was trained on another scene, or on this one before it changed or read in "
                  "another way (--up, --unit, --ignore). Train again (roam train {}), delete the file, or say "
                  "--no-profile",
                  profile.file.string(), scene_name, scene_name));
}

std::string describe(const SceneProfile& profile) {
  const Profile& p = profile.profile;
  std::string text = fmt::format("the body is that of {}: radius {:.3g} m, height {:.3g} m", profile.file.string(),
                                 p.radius, p.height);
  if (p.support_radius > 0.0) text += fmt::format(", support disc of radius {:.3g} m", p.support_radius);
  const WalkerSettings usual;
  if (p.mode == Mode::walk && p.step != usual.step) text += fmt::format(", step {:.3g} m", p.step);
  if (p.mode == Mode::walk && p.slope_degrees != usual.slope_degrees) {
    text += fmt::format(", slope {:.3g} degrees", p.slope_degrees);
  }
  if (!p.regions.empty()) {
    text += ", other sizes in " + words::counted(p.regions.size(), "region");
  }
  if (!p.complete) text += "; its training was interrupted";
  return text;
}

}  // namespace roam::app
