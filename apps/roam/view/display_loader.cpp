#include "view/display_loader.h"

#include <algorithm>
#include <osgDB/Registry>
#include <sstream>

#include "graphics/shading.h"
#include "roam/error.h"
#include "view/collision_loader.h"

namespace roam::app {

DisplayLoader::DisplayLoader(const SceneOptions& scene) : scene_(scene), thread_([this] { run(); }) {}

DisplayLoader::~DisplayLoader() {
  cancelled_ = true;
  thread_.join();
}

LoadState DisplayLoader::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

std::optional<DisplayNode> DisplayLoader::take() {
  const std::lock_guard lock(mutex_);
  if (ready_.empty()) return std::nullopt;
  DisplayNode first = std::move(ready_.front());
  ready_.pop_front();
  return first;
}

std::optional<DisplayReport> DisplayLoader::take_report() {
  const std::lock_guard lock(mutex_);
  std::optional<DisplayReport> taken = std::move(report_);
  report_.reset();
  return taken;
}

bool DisplayLoader::receive(DisplayPart&& part) {
  auto* reader = osgDB::Registry::instance()->getReaderWriterForExtension("osgb");
  if (reader == nullptr) throw Error("OpenSceneGraph's plugin osgb is missing: is its package installed whole?");
  std::istringstream bytes(std::move(part.osgb));
  auto read = reader->readNode(bytes, nullptr);
  if (!read.validNode()) throw Error("a part of the scene came damaged from its reader: " + read.message());
  DisplayNode ready{read.getNode(), part.origin, part.bounds};
  graphics::prepare(*ready.node);
  const std::lock_guard lock(mutex_);
  ready_.push_back(std::move(ready));
  state_.triangles += part.triangles;
  return !cancelled_;
}

void DisplayLoader::run() {
  std::string error;
  try {
    ImportOptions options = import_options(scene_);
    options.progress = [&](const ImportProgress& p) {
      const std::lock_guard lock(mutex_);
      const double share =
          p.bytes_total > 0 ? static_cast<double>(p.bytes_read) / static_cast<double>(p.bytes_total) : 0.0;
      state_.share = std::min(share, 1.0);
      return !cancelled_;
    };
    DisplayReport report =
        read_display(scene_.scenes, options, [this](DisplayPart&& part) { return receive(std::move(part)); });
    const std::lock_guard lock(mutex_);
    report_ = std::move(report);
    state_.phase = LoadState::Phase::done;
    state_.share = 1.0;
    return;
  } catch (const Cancelled&) {
    error = "cancelled";
  } catch (const std::bad_alloc&) {
    error = "out of memory; take a smaller scene or a machine with more memory";
  } catch (const std::exception& e) {
    error = e.what();
  }
  const std::lock_guard lock(mutex_);
  state_.phase = LoadState::Phase::failed;
  state_.error = error;
}

}  // namespace roam::app
