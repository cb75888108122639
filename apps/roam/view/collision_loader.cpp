#include "view/collision_loader.h"

#include <algorithm>
#include <utility>

#include "import/likely_up.h"
#include "roam/error.h"
#include "roam/wander.h"
#include "scenes/arrivals.h"

namespace roam::app {
namespace {

constexpr double longest_wait = 5.0;  // s, for the tiles around the start

}  // namespace

int work_threads(int asked) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return asked > 0 ? asked : std::max(1, cores - 1);
}

void wait_at(Pager& pager, const WalkerSettings& walker, const Vec3& place, const std::function<bool()>& goes_on) {
  const Body body = Body::capsule(walker.radius, walker.height);
  // Wait for the tiles that a body needs if it moves off at once.
  const Vec3 velocity(0.0, 0.0, -walker.speed);
  static_cast<void>(pager.wait(body, place, velocity, longest_wait, 1.0, goes_on));
  if (!goes_on()) throw Cancelled();
}

CollisionLoader::CollisionLoader(const SceneAndStore& what, const CollisionWish& wish)
    : what_(what), wish_(wish), loading_([this] { load(); }) {}

std::optional<Collision> CollisionLoader::take() {
  return loading_.with_state([this](const LoadState&) { return std::exchange(loaded_, std::nullopt); });
}

std::optional<StoreChoice> CollisionLoader::take_choice() {
  return loading_.with_state([this](const LoadState&) { return std::exchange(choice_, std::nullopt); });
}

void CollisionLoader::finish(Collision&& loaded) {
  loading_.with_state([&](LoadState& state) {
    state = {};
    state.phase = LoadState::Phase::done;
    state.share = 1.0;
    state.triangles = loaded.triangles;
    loaded_ = std::move(loaded);
  });
}

void CollisionLoader::load() {
  try {
    choose_and_load();
  } catch (...) {
    if (!place_is_known_) place_.set_exception(std::current_exception());
    throw;
  }
}

void CollisionLoader::choose_and_load() {
  loading_.tell(LoadState::Phase::comparing, 0.0, 0);
  const StoreChoice choice = choose_store(what_, [this] { return loading_.wanted(); });
  loading_.with_state([&](const LoadState&) { choice_ = choice; });
  if (choice.store) {
    load_store(choice.store);
  } else {
    wants_store_ = choice.stale;
    load_scene();
  }
}

void CollisionLoader::load_store(std::shared_ptr<const Store> store) {
  const auto goes_on = [this] { return loading_.wanted(); };
  Collision loaded;
  loaded.triangles = store->info().triangles;
  loaded.identity = identity_of(store->info());
  loading_.tell(LoadState::Phase::looking, 0.0, loaded.triangles);
  loaded.pager = std::make_shared<Pager>(store, PagerOptions{.memory = wish_.memory});
  if (!wish_.place) loaded.start = find_start(*store, wish_.memory, wish_.walker, wish_.mode, goes_on);
  const Vec3 place = wish_.place.value_or(loaded.start ? loaded.start->pose.position : Vec3(0.0));
  place_.set_value({store, place});
  place_is_known_ = true;
  if (wish_.patient) {
    const Body body = Body::capsule(wish_.walker.radius, wish_.walker.height);
    const double reach = std::max(TilesAround::least_reach, wish_.walker.speed);
    TilesAround(*loaded.pager, goes_on).wait(body, place, Vec3(0.0), reach);
    if (!goes_on()) throw Cancelled();
  } else {
    wait_at(*loaded.pager, wish_.walker, place, goes_on);
  }
  finish(std::move(loaded));
}

void CollisionLoader::load_scene() {
  const SceneOptions& options = what_.scene;
  ImportOptions reading = options.import_options();
  reading.progress = [this](const ImportProgress& p) {
    const double share =
        p.bytes_total > 0 ? static_cast<double>(p.bytes_read) / static_cast<double>(p.bytes_total) : 0.0;
    loading_.tell(LoadState::Phase::reading, std::min(share, 1.0), p.triangles);
    if (is_large(p.bytes_total, p.triangles)) wants_store_ = true;
    return loading_.wanted();
  };
  ImportedScene scene = import_scene(options.scenes, reading);
  BuildOptions build;
  build.threads = work_threads(options.threads);
  build.lossless = options.lossless;
  build.progress = [&](double share) {
    loading_.tell(LoadState::Phase::indexing, share, scene.report.triangles);
    return loading_.wanted();
  };
  Collision loaded;
  loaded.world = std::make_shared<const World>(World::build(scene.meshes, build));
  loaded.triangles = loaded.world->stats().triangles;
  for (const Mesh& mesh : scene.meshes) loaded.objects.push_back(mesh.name);
  loaded.report = std::move(scene.report);
  loaded.likely_up = doubted_up(options, scene.meshes);
  loaded.is_upright = stands_upright(scene.meshes);
  loaded.doubted_ceilings =
      doubted_ceilings(options, loaded.report, loaded.likely_up, *loaded.world, floor_samples(scene.meshes));
  loaded.identity = identity_of(scene.meshes);
  if (!wish_.place) {
    loading_.tell(LoadState::Phase::looking, 0.0, loaded.report.triangles);
    loaded.start =
        find_start(*loaded.world, wish_.walker, wish_.mode, scene.meshes, [this] { return loading_.wanted(); });
  }
  if (wish_.keep_meshes) loaded.meshes = std::move(scene.meshes);
  finish(std::move(loaded));
}

}  // namespace roam::app
