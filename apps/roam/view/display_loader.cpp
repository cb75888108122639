#include "view/display_loader.h"

#include <algorithm>
#include <osgDB/Registry>
#include <sstream>
#include <utility>

#include "graphics/shading.h"
#include "roam/error.h"
#include "view/collision_loader.h"

namespace roam::app {

DisplayLoader::DisplayLoader(const SceneOptions& scene) : scene_(scene), loading_([this] { load(); }) {}

std::optional<DisplayNode> DisplayLoader::take() {
  return loading_.with_state([this](const LoadState&) -> std::optional<DisplayNode> {
    if (ready_.empty()) return std::nullopt;
    DisplayNode first = std::move(ready_.front());
    ready_.pop_front();
    return first;
  });
}

std::optional<DisplayReport> DisplayLoader::take_report() {
  return loading_.with_state([this](const LoadState&) { return std::exchange(report_, std::nullopt); });
}

bool DisplayLoader::receive(DisplayPart&& part) {
  auto* reader = osgDB::Registry::instance()->getReaderWriterForExtension("osgb");
  if (reader == nullptr) throw Error("OpenSceneGraph's plugin osgb is missing: is its package installed whole?");
  std::istringstream bytes(std::move(part.osgb));
  auto read = reader->readNode(bytes, nullptr);
  if (!read.validNode()) throw Error("a part of the scene came damaged from its reader: " + read.message());
  DisplayNode ready{read.getNode(), part.origin, part.bounds};
  graphics::prepare(*ready.node);
  loading_.with_state([&](LoadState& state) {
    ready_.push_back(std::move(ready));
    state.triangles += part.triangles;
  });
  return loading_.wanted();
}

void DisplayLoader::load() {
  ImportOptions options = import_options(scene_);
  options.progress = [this](const ImportProgress& p) {
    const double share =
        p.bytes_total > 0 ? static_cast<double>(p.bytes_read) / static_cast<double>(p.bytes_total) : 0.0;
    loading_.with_state([&](LoadState& state) { state.share = std::min(share, 1.0); });
    return loading_.wanted();
  };
  DisplayReport report =
      read_display(scene_.scenes, options, [this](DisplayPart&& part) { return receive(std::move(part)); });
  loading_.with_state([&](LoadState& state) {
    report_ = std::move(report);
    state.phase = LoadState::Phase::done;
    state.share = 1.0;
  });
}

}  // namespace roam::app
