#include "scenes/open_scene.h"

#include <fmt/format.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <new>
#include <thread>

#include "cli/exit_status.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/tell.h"
#include "scenes/free_start.h"
#include "store/build/fingerprint.h"
#include "store/opened.h"

namespace roam::app {
namespace {

/// How long a pager's thread may take to find the name of an unknown part. If all threads wait for reads, it stays
/// unnamed.
constexpr std::chrono::milliseconds longest_naming{200};

/// From now on, large freed blocks return to the system and leave no holes.
void keep_no_large_block() {
#ifdef __GLIBC__
  ::mallopt(M_MMAP_THRESHOLD, 128 << 10);
#endif
}

/// Returns freed memory to the system, so that it is not resident beside later allocations.
void return_memory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

std::shared_ptr<const Store> open_store(const SceneOptions& options, std::uint64_t memory) {
  if (!options.name_a_store()) return nullptr;
  options.demand_store_alone();
  return Store::open(options.scenes.front(), memory, options.web);
}

std::unique_ptr<Pager> make_pager(const std::shared_ptr<const Store>& store, std::uint64_t memory) {
  const auto said = [&] { return "--memory " + short_count(static_cast<double>(memory)) + "B"; };
  if (memory < Pager::least_memory) {
    throw UsageError(said(), fmt::format("a store is walked in {} MiB at least", Pager::least_memory >> 20));
  }
  try {
    return std::make_unique<Pager>(store, PagerOptions{.memory = memory});
  } catch (const std::bad_alloc&) {
    throw Error::at(said(), said() + " is more than this machine gives; a store is walked in less, e.g. --memory 64M");
  }
}

}  // namespace

OpenScene::OpenScene(const SceneOptions& options, Source source)
    : memory_(options.store_memory()), store_(open_store(options, memory_)) {
  if (store_) {
    keep_no_large_block();
    pager_ = make_pager(store_, memory_);
    return;
  }
  loaded_ = load(options, source);
}

const Space& OpenScene::space() const {
  if (pager_) return *pager_;
  return loaded_.world;
}

std::uint64_t OpenScene::triangles() const {
  return store_ ? store_->info().triangles : loaded_.world.stats().triangles;
}

std::uint64_t OpenScene::objects() const { return store_ ? store_->info().objects : loaded_.world.stats().objects; }

Box OpenScene::bounds() const { return store_ ? store_->info().bounds : loaded_.bounds; }

std::optional<PagerStats> OpenScene::paging() const {
  if (!pager_) return std::nullopt;
  return pager_->stats();
}

Vec3 OpenScene::start(const WalkerSettings& settings, Mode mode) {
  if (!store_) return free_start(loaded_.world, settings, mode, loaded_.floors).place;
  // The pager's memory and the memory of the search do not exist at the same time.
  leave();
  const Vec3 place = free_start(*store_, memory_, settings, mode).place;
  return_memory();
  pager_ = make_pager(store_, memory_);
  return place;
}

void OpenScene::leave() {
  around_.reset();
  pager_.reset();
  return_memory();
}

void OpenScene::wait_around(const Body& body, const Vec3& place, const Vec3& velocity, double reach) {
  if (!pager_) return;
  if (!around_) around_.emplace(*pager_, [] { return !interrupted(); });
  around_->wait(body, place, velocity, reach);
}

SourceTriangle OpenScene::source(TriangleId triangle) const {
  if (store_) return store_->source(triangle);
  return {"", triangle, triangle, loaded_.world.object_name(triangle)};
}

TriangleId OpenScene::scene_triangle(TriangleId triangle) const {
  return store_ ? store_->scene_triangle(triangle) : triangle;
}

std::string OpenScene::why_unknown(TriangleId unknown) const {
  const auto until = std::chrono::steady_clock::now() + longest_naming;
  std::string why = space().object_name(unknown);
  while (why.empty() && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    why = space().object_name(unknown);
  }
  return why;
}

void read_as(SceneOptions& scene, const Store& store) {
  ImportOptions options;
  store::read_as(store.state().manifest.options, options);
  if (scene.up.empty() && options.up) scene.up = to_string(*options.up);
  if (scene.unit.empty()) scene.unit = to_string(options.unit);
  if (scene.ignore.empty()) scene.ignore = options.ignore;
}

}  // namespace roam::app
