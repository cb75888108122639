// Compares a pager with a world of the same triangles. First queries with everything in memory, then a flight in real
// time through a store that has not been read yet, with little memory.

#include "roam/pager.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <glm/geometric.hpp>
#include <thread>

#include "program.h"
#include "query_sets.h"
#include "roam/walker.h"
#include "roam/world.h"
#include "run_options.h"
#include "scene.h"
#include "store_made.h"
#include "timing.h"

namespace {

using namespace roam::bench;
using roam::Vec3;

struct Options : RunOptions {
  std::string store;
  std::uint64_t memory_mib = 64;
  std::uint32_t tile_triangles = 0;
  double speed = 50.0;
  double seconds = 20.0;
  int loaders = 1;
};

void load_all(roam::Pager& pager, const Vec3& place) {
  while (pager.stats().tiles < pager.store().info().tiles) {
    (void)pager.update({0.3, 0.0}, place, Vec3(0.0));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void print(const char* what, const std::string& set, const Summary& world, const Summary& pager) {
  std::printf("%-10s %-9s %8.0f %8.0f %8.0f %8.0f   %5.2f %5.2f\n", what, set.c_str(), world.p50, world.p99, pager.p50,
              pager.p99, pager.p50 / world.p50, pager.p99 / world.p99);
  std::fflush(stdout);
}

/// Times the same queries on a world and on a pager with everything in memory, in turns.
void compare(const Options& options, const Scene& scene, const roam::World& world, const roam::Pager& pager) {
  const Reference reference(scene.meshes);
  std::printf("%-10s %-9s %8s %8s %8s %8s   ratio\n", "query", "set", "world50", "world99", "pager50", "pager99");
  const auto sweep = [](const roam::Space& space) {
    return timed([&space](const Query& q) {
      const roam::Impact s = space.sweep(q.body, q.from, q.motion);
      return Answer{s.hit, s.time};
    });
  };
  const auto clearance = [](const roam::Space& space) {
    return timed([&space](const Query& q) {
      const roam::Clearance c = space.clearance(q.body, q.from, q.motion, 1.0);
      return Answer{c.found, c.distance};
    });
  };
  for (const std::string& name : options.sets) {
    const QuerySet set = make_queries(name, options.queries, reference);
    const std::vector<bool> hits(set.queries.size(), false);
    const std::size_t counts[] = {set.queries.size(), set.queries.size()};
    const Ask sweeps[] = {sweep(world), sweep(pager)};
    const auto t = time_in_turns(sweeps, counts, set.queries, options.rounds);
    print("sweep", name, summarize(t[0], hits), summarize(t[1], hits));
    if (name == "long") continue;
    const Ask clearances[] = {clearance(world), clearance(pager)};
    const auto u = time_in_turns(clearances, counts, set.queries, options.rounds);
    print("clearance", name, summarize(u[0], hits), summarize(u[1], hits));
  }
}

void print(const char* what, std::vector<double> times) {
  std::sort(times.begin(), times.end());
  const auto at = [&](double part) { return 1e6 * quantile(times, part); };
  std::printf("%-10s p50 %7.2f  p99 %7.2f  p99.9 %7.2f  max %8.2f us\n", what, at(0.5), at(0.99), at(0.999), at(1.0));
}

/// Flies to and fro, 60 steps a second in real time. `pager` is null for a space that needs no update.
void fly(const Options& options, const roam::Space& space, roam::Pager* pager, const Vec3& start) {
  using Clock = std::chrono::steady_clock;
  roam::Walker walker(space, {.radius = 0.3, .height = 0.6, .eye = 0.3}, roam::Mode::fly, start);
  std::vector<double> steps, updates;
  double length = 0.0, heading = 0.3;
  long slowed = 0, unknown = 0;
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  auto due = Clock::now();
  for (int i = 0; i < static_cast<int>(60.0 * options.seconds); ++i) {
    if (walker.report().blocked || i % 90 == 89) heading += 2.1;
    const Vec3 from = walker.position();
    const auto a = Clock::now();
    walker.step({.velocity = options.speed * Vec3(std::cos(heading), std::sin(heading), 0.1 * std::sin(0.02 * i))},
                1.0 / 60.0);
    const auto b = Clock::now();
    if (pager) (void)pager->update(walker.body(), walker.position(), walker.velocity());
    const auto c = Clock::now();
    steps.push_back(seconds(b - a));
    updates.push_back(seconds(c - b));
    length += glm::length(walker.position() - from);
    slowed += walker.report().has(roam::EventKind::slowed) ? 1 : 0;
    unknown += walker.report().met_unknown ? 1 : 0;
    due += std::chrono::microseconds(16'667);
    std::this_thread::sleep_until(due);
  }
  print("step", steps);
  if (!pager) return;
  print("update", updates);
  const roam::PagerStats s = pager->stats();
  std::printf(
      "%.0f m in %.0f s, %ld steps slowed, %ld met the unknown; %llu loads, %llu evictions, %.1f MB read, worst "
      "read %.2f ms, worst decoding %.2f ms; memory %.2f MiB, used %.2f MiB\n",
      length, options.seconds, slowed, unknown, static_cast<unsigned long long>(s.loads),
      static_cast<unsigned long long>(s.evictions), 1e-6 * static_cast<double>(s.bytes_read), 1e3 * s.longest_read,
      1e3 * s.longest_decode, static_cast<double>(s.memory) / (1 << 20), static_cast<double>(s.used) / (1 << 20));
}

int run(const Options& options) {
  const made::Folder folder("bench_pager");
  std::shared_ptr<const roam::Store> store;
  Vec3 start(0.0);
  if (options.store.empty()) {
    const Scene scene = make_scene(options.scenes.front());
    std::printf("%s\n", scene.name.c_str());
    store = made::store(folder.path(), scene.meshes,
                        {.page_tiles = roam::store::page_tiles, .tile_triangles = options.tile_triangles});
    const roam::World world = roam::World::build(scene.meshes, {});
    const Reference reference(scene.meshes);
    start = make_queries("coherent", 1, reference).queries[0].from;
    roam::Pager pager(store, {.memory = std::max<std::uint64_t>(64 << 20, 2 * store->info().resident_bytes)});
    load_all(pager, start);
    compare(options, scene, world, pager);
    std::printf("a flight through the world, %.1f m/s\n", options.speed);
    fly(options, world, nullptr, start);
  } else {
    store = roam::Store::open(options.store);
    start = store->info().bounds.center();
  }
  std::printf("%llu triangles, %.1f MiB if all were in memory, %llu tiles, %llu pages; %llu MiB of memory, %.1f m/s\n",
              static_cast<unsigned long long>(store->info().triangles),
              static_cast<double>(store->info().resident_bytes) / (1 << 20),
              static_cast<unsigned long long>(store->info().tiles),
              static_cast<unsigned long long>(store->info().pages), static_cast<unsigned long long>(options.memory_mib),
              options.speed);
  roam::Pager pager(store, {.memory = options.memory_mib << 20, .loaders = options.loaders});
  fly(options, pager, &pager, start);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"Times a pager beside a world, and a flight through a store"};
  options.add_to(app);
  app.add_option("--store", options.store, "fly through this store only");
  app.add_option("--memory", options.memory_mib, "MiB, for the flight")->capture_default_str();
  app.add_option("--tile-triangles", options.tile_triangles,
                 "triangles of a tile at most, in a made store; 0: as in a world");
  app.add_option("--speed", options.speed, "speed of the flight, in metres per second")->capture_default_str();
  app.add_option("--seconds", options.seconds, "length of the flight, in seconds")->capture_default_str();
  app.add_option("--loaders", options.loaders, "loading threads")->capture_default_str();
  return run_program(app, argc, argv, [&] { return run(options); });
}
