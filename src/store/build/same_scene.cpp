#include "store/build/same_scene.h"

#include <algorithm>

#include "store/build/fingerprint.h"
#include "store/build/layout.h"
#include "store/opened.h"

namespace roam::store {

std::string difference(const Store& store, std::span<const std::filesystem::path> scene, const ImportOptions& import,
                       bool lossless, const std::optional<StoreKey>& key, const std::function<void()>& tick) {
  const Manifest& manifest = store.state().manifest;
  const std::string options = text_of(import);
  if (manifest.options != options) return "it was built with other options (--up, --unit, --ignore, --allow)";
  if (lossless && !manifest.lossless) return "it was built without --lossless";
  const std::vector<ScenePart> parts = scene_parts(scene, import);
  for (std::size_t i = 0; i < std::min(parts.size(), manifest.parts.size()); ++i) {
    if (parts[i].name != manifest.parts[i].name) return parts[i].name + " is new, or in another place";
  }
  if (parts.size() > manifest.parts.size()) return parts[manifest.parts.size()].name + " is new";
  if (parts.size() < manifest.parts.size()) return manifest.parts[parts.size()].name + " is gone";
  Sources sources(store.name(), key, import);
  std::vector<SourcePart> recorded;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::optional<SourcePart> part = sources.with_references(parts[i], manifest.parts[i].references);
    if (!part) return parts[i].name + " has changed since";
    recorded.push_back(std::move(*part));
  }
  sources.look(recorded, tick);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (sources.fingerprint(recorded[i], options) != manifest.parts[i].fingerprint) {
      return parts[i].name + ", or a file that it refers to, has changed since";
    }
  }
  return "";
}

}  // namespace roam::store
