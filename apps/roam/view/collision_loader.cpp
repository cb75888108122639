#include "view/collision_loader.h"

#include <algorithm>
#include <chrono>

#include "floors.h"
#include "roam/error.h"

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
    : scene_(scene), wish_(wish), phase_start_(Clock::now()), thread_([this] { run(); }) {}

CollisionLoader::~CollisionLoader() {
  cancelled_ = true;
  thread_.join();
}

LoadState CollisionLoader::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

std::optional<Collision> CollisionLoader::take() {
  const std::lock_guard lock(mutex_);
  std::optional<Collision> taken = std::move(loaded_);
  loaded_.reset();
  return taken;
}

void CollisionLoader::set(LoadState::Phase phase, double share, std::uint64_t triangles) {
  const std::lock_guard lock(mutex_);
  if (phase != state_.phase) phase_start_ = Clock::now();
  state_.phase = phase;
  state_.share = share;
  state_.triangles = std::max(triangles, state_.triangles);
  const double seconds = std::chrono::duration<double>(Clock::now() - phase_start_).count();
  // What is told after a moment's work, or of its first hundredth, is a guess that only confuses.
  constexpr double least_seconds = 1.0;
  constexpr double least_share = 0.01;
  state_.seconds_left = seconds > least_seconds && share > least_share ? seconds * (1.0 / share - 1.0) : -1.0;
}

void CollisionLoader::load() {
  ImportOptions reading = import_options(scene_);
  reading.progress = [this](const ImportProgress& p) {
    const double share =
        p.bytes_total > 0 ? static_cast<double>(p.bytes_read) / static_cast<double>(p.bytes_total) : 0.0;
    set(LoadState::Phase::reading, std::min(share, 1.0), p.triangles);
    return !cancelled_;
  };
  Scene scene = import_scene(scene_.scenes, reading);
  BuildOptions build;
  build.threads = build_threads(scene_.threads);
  build.lossless = scene_.lossless;
  build.progress = [&](double share) {
    set(LoadState::Phase::indexing, share, scene.report.triangles);
    return !cancelled_;
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
    loaded.start = find_start(*loaded.world, wish_.walker, wish_.mode, floors, [this] { return !cancelled_; });
  }
  const std::lock_guard lock(mutex_);
  loaded_ = std::move(loaded);
  state_ = {};
  state_.phase = LoadState::Phase::done;
  state_.share = 1.0;
  state_.triangles = loaded_->report.triangles;
}

void CollisionLoader::run() {
  std::string error;
  try {
    load();
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
