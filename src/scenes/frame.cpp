#include "scenes/frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/tell.h"
#include "roam/error.h"
#include "roam/import.h"
#include "roam/profile.h"
#include "store/build/fingerprint.h"
#include "store/opened.h"

namespace roam::app {

namespace {

/// The frame of a store's parts, read with these options.
std::optional<SceneFrame> frame_of_parts(const Store& store, const ImportOptions& options) {
  std::vector<std::filesystem::path> parts;
  for (const store::PartInfo& part : store.state().manifest.parts) parts.emplace_back(part.name);
  return frame_of(parts, options);
}

}  // namespace

std::optional<SceneFrame> frame_of(const Store& store) {
  return frame_of_parts(store, store::stated_in(store.state().manifest.options));
}

std::optional<SceneFrame> frame_of(const SceneOptions& scene) {
  if (!scene.name_a_store()) return frame_of(scene.scenes, scene.import_options());
  try {
    return frame_of(*Store::open(scene.scenes.front(), scene.manifest_memory(), scene.web));
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::optional<SceneFrame> usual_frame_of(SceneOptions scene) {
  scene.up.clear();
  scene.unit.clear();
  return frame_of(scene);
}

void take_kept_frame(SceneOptions& scene) {
  const bool nameless =
      std::any_of(scene.scenes.begin(), scene.scenes.end(), [](const auto& file) { return file.empty(); });
  // The readers refuse a scene without a name.
  if (scene.no_profile || scene.scenes.empty() || nameless) return;
  if (!scene.up.empty() || !scene.unit.empty() || scene.name_a_store()) return;
  std::optional<SceneFrame> kept;
  try {
    kept = find_frame(scene.scenes);
  } catch (const Error& error) {
    scene.check_there();  // the profile may be out of reach because the scene is
    throw Error::at(error.where(), std::string(error.what()) + "; --no-profile does without it");
  }
  if (!kept || kept == frame_of(scene)) return;
  scene.up = to_string(kept->up);
  scene.unit = to_string(kept->unit);
  scene.frame_file = profile_path(scene.scenes);
  tell(
      fmt::format("note: {} is read with {}, as {} says", scene.names(), options_of(*kept), scene.frame_file.string()));
}

std::string kept_frame_line(const SceneOptions& scene) {
  if (scene.frame_file.empty()) return {};
  return fmt::format("  {:<12}{}, from {}\n", "frame", options_of(*frame_of(scene)),
                     printable_part(scene.frame_file.string()));
}

std::optional<SceneFrame> frame_to_keep(const SceneOptions& scene) {
  const std::optional<SceneFrame> frame = frame_of(scene);
  const std::optional<SceneFrame> usual =
      scene.name_a_store() ? frame_of_parts(*Store::open(scene.scenes.front(), scene.manifest_memory(), scene.web), {})
                           : usual_frame_of(scene);
  return frame == usual ? std::nullopt : frame;
}

SceneFrame next_frame(const SceneFrame& frame, const std::optional<UpAxis>& likely) {
  if (likely) return {*likely, frame.unit};
  constexpr std::array<UpAxis, 6> circle{UpAxis::z,       UpAxis::y,       UpAxis::x,
                                         UpAxis::minus_z, UpAxis::minus_y, UpAxis::minus_x};
  const auto at = static_cast<std::size_t>(std::find(circle.begin(), circle.end(), frame.up) - circle.begin());
  return {circle[(at + 1) % circle.size()], frame.unit};
}

std::string options_of(const SceneFrame& frame) {
  std::string text = fmt::format("--up={}", to_string(frame.up));
  if (frame.unit != LengthUnit::m) text += fmt::format(" --unit={}", to_string(frame.unit));
  return text;
}

std::string options_for(const SceneFrame& wanted, const SceneFrame& now) {
  const bool to_metres = wanted.unit == LengthUnit::m && now.unit != LengthUnit::m;
  return options_of(wanted) + (to_metres ? " --unit=m" : "");
}

Json to_json(const std::optional<SceneFrame>& frame) {
  if (!frame) return nullptr;
  Json json = {{"up", to_string(frame->up)}, {"unit", to_string(frame->unit)}, {"matrix", Json::array()}};
  for (const auto& row : frame->to_file()) json["matrix"].push_back(row);
  return json;
}

}  // namespace roam::app
