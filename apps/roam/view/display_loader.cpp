#include "view/display_loader.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "roam/error.h"
#include "view/store_triangles.h"

namespace roam::app {
namespace {

/// If there are several scenes, puts a scene's objects into a group with its file's name. Pages, whose names come
/// later, get no group.
void put_below_file(DisplayPart& part, const std::vector<std::filesystem::path>& scenes) {
  if (scenes.size() < 2 || part.source >= scenes.size() || !part.pages.empty()) return;
  const std::filesystem::path& file = scenes[part.source];
  const std::string group = (file.has_filename() ? file : file.parent_path()).filename().string();
  for (std::string& name : part.objects) name.insert(0, group + DisplayPart::name_separator);
}

}  // namespace

DisplayLoader::DisplayLoader(const SceneOptions& scene, const TextureQuality& quality,
                             std::shared_ptr<SceneObjects> objects, const PageSettings& pages)
    : scene_(scene),
      pages_(new PageSource(scene.scenes, scene.import_options(), quality, std::move(objects), pages)),
      loading_([this] { load_scene(); }) {}

DisplayLoader::DisplayLoader(std::future<PlaceInStore> place)
    : place_(std::move(place)),
      pages_(new PageSource({}, {}, {}, std::make_shared<SceneObjects>())),
      loading_([this] { load_store(); }) {}

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

bool DisplayLoader::receive(const DisplayPart& part) {
  DisplayNode ready{pages_->make(part), part.origin, part.bounds, !part.pages.empty()};
  loading_.with_state([&](LoadState& state) {
    ready_.push_back(std::move(ready));
    state.triangles += part.triangles;
  });
  return loading_.wanted();
}

void DisplayLoader::load_scene() {
  ImportOptions options = scene_.import_options();
  options.progress = [this](const ImportProgress& p) {
    const double share =
        p.bytes_total > 0 ? static_cast<double>(p.bytes_read) / static_cast<double>(p.bytes_total) : 0.0;
    loading_.with_state([&](LoadState& state) { state.share = std::min(share, 1.0); });
    return loading_.wanted();
  };
  finish(read_display(scene_.scenes, options, [this](DisplayPart&& part) {
    put_below_file(part, scene_.scenes);
    return receive(part);
  }));
}

void DisplayLoader::load_store() {
  constexpr auto a_moment = std::chrono::milliseconds(20);
  while (place_.wait_for(a_moment) != std::future_status::ready) {
    if (!loading_.wanted()) throw Cancelled();
  }
  const PlaceInStore at = place_.get();
  const auto take = [this](DisplayNode&& node, std::uint64_t triangles) {
    loading_.with_state([&](LoadState& state) {
      ready_.push_back(std::move(node));
      state.triangles += triangles;
    });
  };
  finish(show_store(*at.store, at.place, take, [this] { return loading_.wanted(); }));
}

void DisplayLoader::finish(DisplayReport&& report) {
  loading_.with_state([&](LoadState& state) {
    report_ = std::move(report);
    state.phase = LoadState::Phase::done;
    state.share = 1.0;
  });
}

}  // namespace roam::app
