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
  if (manifest.options != options) return "it was built with other options (--up, --unit, --ignore)";
  if (lossless && !manifest.lossless) return "it was built without --lossless";
  const std::vector<ScenePart> parts = scene_parts(scene, import);
  for (std::size_t i = 0; i < std::min(parts.size(), manifest.parts.size()); ++i) {
    if (parts[i].name != manifest.parts[i].name) return parts[i].name + " is new, or in another place";
  }
  if (parts.size() > manifest.parts.size()) return parts[manifest.parts.size()].name + " is new";
  if (parts.size() < manifest.parts.size()) return manifest.parts[parts.size()].name + " is gone";
  Sources sources(store.name(), key);
  sources.look(parts, import, tick);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (sources.fingerprint(parts[i], options) != manifest.parts[i].fingerprint) {
      return parts[i].name + " has changed since";
    }
  }
  return "";
}

}  // namespace roam::store
