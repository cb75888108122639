#include <memory>

#include "engine.h"
#include "memory.h"
#include "roam/world.h"

namespace roam::bench {

Engine make_roam(const Scene& scene) {
  Engine engine{.name = "roam", .used = "World::sweep; rays: first_impact; nearest: clearance", .rays = true};
  const auto world = std::make_shared<World>();
  engine.build_one = seconds([&] { *world = World::build(scene.meshes, {.threads = 1, .progress = {}}); });
  *world = World();
  const std::size_t before = allocated_bytes();
  engine.build_two = seconds([&] { *world = World::build(scene.meshes, {.threads = 2, .progress = {}}); });
  // The allocator's count, if available, also covers memory that the world does not count.
  const std::size_t after = allocated_bytes();
  engine.bytes = after > before ? after - before : world->stats().bytes;
  engine.ask = timed([world](const Query& query) {
    if (query.body.radius == 0) {
      const FirstImpact first = world->first_impact(query.body, query.from, query.motion);
      return Answer{first.hit, first.time};
    }
    const Impact sweep = world->sweep(query.body, query.from, query.motion);
    return Answer{sweep.hit, sweep.time};
  });
  engine.nearest = timed([world](const Query& query) {
    return Answer{.distance = world->clearance(query.body, query.from, nearest_reach).distance};
  });
  return engine;
}

}  // namespace roam::bench
