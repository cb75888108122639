// Spaces: worlds, stores, and these without some objects.
#include "roam/world.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <future>
#include <glm/geometric.hpp>
#include <limits>

#include "c/meshes.h"
#include "c/query.h"
#include "c/space.h"
#include "c/structs.h"
#include "c/walker.h"
#include "process/thread_without_signals.h"
#include "roam/version.h"
#include "store/bytes.h"
#include "store/web_files.h"

namespace roam::c {
namespace {

/// Of a world and of its construction.
constexpr std::size_t bytes_a_triangle = 45;

roam_space* new_world(std::span<const Mesh> meshes, const roam_world_options& options, Progress& progress) {
  BuildOptions how;
  how.threads = options.threads;
  how.lossless = options.lossless != 0;
  how.progress = [&](double done) { return progress.goes_on(done); };
  auto world = std::make_shared<World>(World::build(meshes, how));
  auto handle = std::make_unique<roam_space>();
  handle->world = world.get();
  handle->space = std::move(world);
  return handle.release();
}

/// Opens a store on a web server. A server may be silent for long; so another thread waits for it.
std::shared_ptr<const Store> opened_there(const char* address, const WebAccess& web, Progress& progress) {
  constexpr std::chrono::milliseconds between_calls{10};
  std::stop_source stop;
  std::packaged_task<std::shared_ptr<const Store>()> task([&] {
    const store::WebStore there = store::web_store(address, web, stop.get_token());
    return store::open_store(there.bytes, there.name);
  });
  std::future<std::shared_ptr<const Store>> opened = task.get_future();
  std::thread opening = process::thread_without_signals(std::move(task));
  while (opened.wait_for(between_calls) != std::future_status::ready) {
    if (!progress.goes_on(0.0)) stop.request_stop();
  }
  opening.join();
  if (stop.stop_requested()) throw Cancelled();
  return opened.get();
}

}  // namespace
}  // namespace roam::c

using namespace roam::c;
using roam::Vec3;

uint32_t roam_interface(void) { return ROAM_INTERFACE; }
const char* roam_version(void) { return ROAM_VERSION_STRING; }

roam_status roam_world_build(const roam_mesh* meshes, size_t count, const roam_world_options* options,
                             roam_space** world) {
  return guarded([&] {
    (void)needed(world, "the address for the world");
    const auto how = given_or_default(options, "roam_world_options");
    Progress progress(how.progress, how.progress_data);
    *world = new_world(copied(meshes, count, bytes_a_triangle), how, progress);
  });
}

roam_status roam_world_open(const char* path, const roam_world_options* options, roam_space** world) {
  return guarded(path, [&] {
    (void)needed(world, "the address for the world");
    (void)needed(path, "the path");
    const auto how = given_or_default(options, "roam_world_options");
    Progress progress(how.progress, how.progress_data);
    const std::vector<roam::Mesh> meshes = imported(path, how, progress);
    about_arguments([&] { *world = new_world(meshes, how, progress); });
  });
}

roam_status roam_store_open(const char* path, const roam_store_options* options, roam_space** store) {
  return guarded(path, [&] {
    (void)needed(store, "the address for the store");
    (void)needed(path, "the path");
    const auto how = given_or_default(options, "roam_store_options");
    roam::PagerOptions pager;
    if (how.memory != 0) pager.memory = how.memory;
    if (how.loaders != 0) pager.loaders = how.loaders;
    if (how.horizon != 0.0) pager.horizon = how.horizon;
    roam::WebAccess web;
    if (how.cache != nullptr) web.cache = how.cache;
    if (how.cache_bytes != 0) web.cache_bytes = how.cache_bytes;
    if (how.patience != 0.0) web.patience = how.patience;
    web.redirects = how.redirects != 0;
    about_arguments([&] { roam::store::check(web); });
    Progress progress(how.progress, how.progress_data);
    auto opened = roam::Store::is_address(path) ? opened_there(path, web, progress) : roam::Store::open(path);
    auto space = about_arguments([&] { return std::make_shared<StoreSpace>(std::move(opened), pager); });
    auto handle = std::make_unique<roam_space>();
    handle->store = space.get();
    handle->live = space.get();
    handle->space = std::move(space);
    *store = handle.release();
  });
}

roam_status roam_filtered_create(const roam_space* space, roam_space** filtered) {
  return guarded([&] {
    const roam_space& of = needed(space, "the space");
    (void)needed(filtered, "the address for the space");
    auto handle = std::make_unique<roam_space>(of);
    // Keeps the space below alive.
    const std::shared_ptr<roam::Filtered> made(
        of.live != nullptr ? new roam::Filtered(*of.live) : new roam::Filtered(*of.space),
        [below = of.space](roam::Filtered* it) { delete it; });
    handle->filtered = made.get();
    if (of.live != nullptr) handle->live = made.get();
    handle->space = made;
    *filtered = handle.release();
  });
}

roam_status roam_filtered_ignore_only(roam_space* filtered, const uint32_t* objects, size_t count) {
  return guarded([&] {
    roam::Filtered* space = needed(filtered, "the space").filtered;
    if (space == nullptr) throw Invalid("this space does not come from roam_filtered_create()");
    if (count > 0) (void)needed(objects, "the array of objects");
    check_ignored(*filtered, {objects, count});
    space->ignore_only({objects, count});
  });
}

void roam_space_free(roam_space* space) { delete space; }

roam_status roam_space_get_facts(const roam_space* space, roam_space_facts* facts) {
  return guarded([&] {
    const roam_space& of = needed(space, "the space");
    check_room(facts, "roam_space_facts");
    const roam::SpaceFacts known = of.space->facts();
    roam_space_facts result{};
    result.lower = c_of(known.bounds.lower);
    result.upper = c_of(known.bounds.upper);
    result.largest_error = known.largest_error;
    result.speed_limit = known.speed_limit;
    result.ready = std::numeric_limits<double>::infinity();
    if (of.world != nullptr) {
      result.triangles = of.world->stats().triangles;
      result.objects = of.world->stats().objects;
      result.bytes = of.world->stats().bytes;
    } else {
      const roam::PagerStats stats = of.store->pager.stats();
      result.triangles = of.store->pager.store().info().triangles;
      result.objects = of.store->pager.store().info().objects;
      result.bytes = stats.memory;
      result.failed = stats.failed;
      result.ready = stats.ready_radius;
    }
    put(*facts, result);
  });
}

size_t roam_object_name(const roam_space* space, uint64_t triangle, char* name, size_t capacity) {
  std::string text;
  (void)guarded([&] { text = needed(space, "the space").space->object_name(triangle); });
  if (name != nullptr && capacity > 0) {
    const std::size_t length = std::min(text.size(), capacity - 1);
    std::memcpy(name, text.data(), length);
    name[length] = '\0';
  }
  return text.size();
}

roam_status roam_space_update(roam_space* space, const roam_walker* walker, int32_t* changed) {
  return guarded([&] {
    roam_space& of = needed(space, "the space");
    const roam::Walker& body = needed(walker, "the walker").walker;
    const bool did = of.live != nullptr && of.live->update(body.body(), body.position(), body.velocity());
    if (changed != nullptr) *changed = did ? 1 : 0;
  });
}

roam_status roam_space_load(roam_space* space, const roam_query* query, double seconds, roam_progress progress,
                            void* progress_data, int32_t* complete) {
  return guarded([&] {
    roam_space& of = needed(space, "the space");
    const roam_query what = given(query, "roam_query");
    (void)needed(complete, "the address for the result");
    if (!(seconds >= 0.0)) throw Invalid("the time to load is negative or not a number");
    if (of.store == nullptr) {
      *complete = 1;
      return;
    }
    // At a velocity of its length a second, the whole motion is what a body reaches within one second.
    constexpr double ahead = 1.0;
    Progress goes_on(progress, progress_data);
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    const bool known = of.store->pager.wait(
        {what.radius, what.half_height}, cpp_of(what.from), cpp_of(what.motion), seconds, ahead, [&] {
          goes_on.check(std::min(1.0, std::chrono::duration<double>(Clock::now() - begin).count() / seconds));
          return true;
        });
    *complete = known && glm::length(cpp_of(what.motion)) <= roam::Space::reach_limit ? 1 : 0;
  });
}
