#include "view/collision_loader.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "floors.h"

namespace roam::app {
namespace {

using Clock = std::chrono::steady_clock;

/// Building on all cores but one: the window stays smooth.
int build_threads(int asked) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return asked > 0 ? asked : std::max(1, cores - 1);
}

}  // namespace

ImportOptions import_options(const SceneOptions& scene) {
  ImportOptions options;
  if (!scene.up.empty()) options.up = parse_up_axis(scene.up);
  options.unit = parse_length_unit(scene.unit);
  options.ignore = scene.ignore;
  return options;
}

CollisionLoader::CollisionLoader(const SceneOptions& scene, const CollisionWish& wish)
    : scene_(scene), wish_(wish), phase_start_(Clock::now()), loading_([this] { load(); }) {}

std::optional<Collision> CollisionLoader::take() {
  return loading_.with_state([this](const LoadState&) { return std::exchange(loaded_, std::nullopt); });
}

void CollisionLoader::set(LoadState::Phase phase, double share, std::uint64_t triangles) {
  loading_.with_state([&](LoadState& state) {
    if (phase != state.phase) phase_start_ = Clock::now();
    state.phase = phase;
    state.share = share;
    state.triangles = std::max(triangles, state.triangles);
    const double seconds = std::chrono::duration<double>(Clock::now() - phase_start_).count();
    // What is told after a moment's work, or of its first hundredth, is a guess that only confuses.
    constexpr double least_seconds = 1.0;
    constexpr double least_share = 0.01;
    state.seconds_left = seconds > least_seconds && share > least_share ? seconds * (1.0 / share - 1.0) : -1.0;
  });
}

void CollisionLoader::load() {
  ImportOptions reading = import_options(scene_);
  reading.progress = [this](const ImportProgress& p) {
    const double share =
        p.bytes_total > 0 ? static_cast<double>(p.bytes_read) / static_cast<double>(p.bytes_total) : 0.0;
    set(LoadState::Phase::reading, std::min(share, 1.0), p.triangles);
    return loading_.wanted();
  };
  Scene scene = import_scene(scene_.scenes, reading);
  BuildOptions build;
  build.threads = build_threads(scene_.threads);
  build.lossless = scene_.lossless;
  build.progress = [&](double share) {
    set(LoadState::Phase::indexing, share, scene.report.triangles);
    return loading_.wanted();
  };
  std::vector<Vec3> floors;
  if (wish_.find_start) floors = floor_samples(scene.meshes);
  Collision loaded;
  loaded.world = std::make_shared<const World>(World::build(scene.meshes, build));
  loaded.report = std::move(scene.report);
  if (wish_.keep_meshes) loaded.meshes = std::move(scene.meshes);
  scene.meshes.clear();
  scene.meshes.shrink_to_fit();
  if (wish_.find_start) {
    set(LoadState::Phase::looking, 0.0, loaded.report.triangles);
    loaded.start = find_start(*loaded.world, wish_.walker, wish_.mode, floors, [this] { return loading_.wanted(); });
  }
  loading_.with_state([&](LoadState& state) {
    state = {};
    state.phase = LoadState::Phase::done;
    state.share = 1.0;
    state.triangles = loaded.report.triangles;
    loaded_ = std::move(loaded);
  });
}

}  // namespace roam::app
