#include "scenes/frame.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "roam/import.h"
#include "store/build/fingerprint.h"
#include "store/opened.h"

namespace roam::app {

std::optional<SceneFrame> frame_of(const Store& store) {
  const store::Manifest& manifest = store.state().manifest;
  std::vector<std::filesystem::path> parts;
  for (const store::PartInfo& part : manifest.parts) parts.emplace_back(part.name);
  return frame_of(parts, store::stated_in(manifest.options));
}

std::optional<SceneFrame> frame_of(const SceneOptions& scene) {
  if (!scene.name_a_store()) return frame_of(scene.scenes, scene.import_options());
  try {
    return frame_of(*Store::open(scene.scenes.front()));
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::string options_of(const SceneFrame& frame) {
  std::string text = fmt::format("--up={}", to_string(frame.up));
  if (frame.unit != LengthUnit::m) text += fmt::format(" --unit={}", to_string(frame.unit));
  return text;
}

Json to_json(const std::optional<SceneFrame>& frame) {
  if (!frame) return nullptr;
  Json json = {{"up", to_string(frame->up)}, {"unit", to_string(frame->unit)}, {"matrix", Json::array()}};
  for (const auto& row : frame->to_file()) json["matrix"].push_back(row);
  return json;
}

}  // namespace roam::app
