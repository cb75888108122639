// The time of a step in finer and finer stores of the same scene, and in a world in memory. One flight along a path
// through each; a table and a picture.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "charts.h"
#include "cli/values.h"
#include "counted_space.h"
#include "draw/picture_file.h"
#include "program.h"
#include "roam/generate.h"
#include "roam/pager.h"
#include "roam/route.h"
#include "roam/world.h"
#include "thread_clock.h"
#include "timing.h"

namespace {

using namespace roam::bench;
using roam::Vec3;

/// Seconds. The limit for loading the surroundings of the start.
constexpr double longest_wait = 60.0;

/// The first path of the paper, through its gallery.
const std::vector<Vec3> first_path = {roam::generate::gallery_paths[0].from, roam::generate::gallery_paths[0].to};

struct Options {
  std::vector<std::string> stores;
  std::vector<std::uint64_t> galleries;
  std::uint64_t memory_mib = 64;
  double speed = 50.0;
  bool walk = false, queries = false;
  int rounds = 3;
  std::string picture;
};

/// One flight along the path: nanoseconds and queries of each step.
struct Flight {
  std::vector<double> times;
  std::array<CountedSpace::Tally, CountedSpace::kinds> asked;
};

roam::WalkerSettings body_of(const Options& options) {
  roam::WalkerSettings settings{.radius = 0.3, .height = 0.6, .eye = 0.6, .speed = options.speed};
  if (options.walk) settings.height = 1.8;
  return settings;
}

/// Flies along the path. Calls `after(walker, report)` after each step; this is not timed.
template <class After>
Flight fly(const Options& options, const roam::Space& space, const After& after) {
  const CountedSpace counted(space);
  const roam::Space& asked = options.queries ? counted : space;
  roam::Walker walker(asked, body_of(options), options.walk ? roam::Mode::walk : roam::Mode::fly, first_path[0]);
  roam::Route route(walker, first_path, {.speed = options.speed});
  const double reading = cost_of_reading();
  Flight flight;
  while (!route.done()) {
    const double begin = thread_time();
    const roam::StepReport& report = route.advance();
    flight.times.push_back(std::max(0.0, thread_time() - begin - reading));
    after(walker, report);
  }
  if (route.result().outcome != roam::Outcome::reached) throw roam::Error("the flight did not reach its end");
  flight.asked = counted.tallies();
  return flight;
}

/// Flies like `roam walk`: after a step it waits until the surroundings have loaded, at most as long as the step lasts.
Flight fly(const Options& options, const std::shared_ptr<const roam::Store>& store) {
  roam::Pager pager(store, {.memory = options.memory_mib << 20});
  const roam::WalkerSettings settings = body_of(options);
  (void)pager.wait(roam::Body::capsule(settings.radius, settings.height), first_path[0], Vec3(0.0), longest_wait);
  return fly(options, pager, [&](const roam::Walker& walker, const roam::StepReport& report) {
    (void)pager.wait(walker.body(), walker.position(), walker.velocity(), report.elapsed);
  });
}

/// Prints the number of queries of a step by kind, and their times, for one flight with every query timed.
void print_queries(const Flight& flight, std::uint64_t triangles) {
  const auto steps = static_cast<double>(flight.times.size());
  for (std::size_t kind = 0; kind < CountedSpace::kinds; ++kind) {
    const CountedSpace::Tally& t = flight.asked[kind];
    if (t.asked == 0) continue;
    const auto asked = static_cast<double>(t.asked);
    std::printf("%12llu %10s: %.2f a step, %.0f ns each\n", static_cast<unsigned long long>(triangles),
                CountedSpace::names[kind], asked / steps, t.nanoseconds / asked);
  }
}

int run(const Options& options) {
  if (options.stores.empty() && options.galleries.empty()) {
    throw roam::Error("there is nothing to fly through: name a store, or --gallery N");
  }
  struct Rounds {
    std::shared_ptr<const roam::Store> store;
    std::shared_ptr<const roam::World> world;
    std::vector<double> p50, p99, most;
    std::size_t steps = 0;

    [[nodiscard]] std::uint64_t triangles() const { return store ? store->info().triangles : world->stats().triangles; }
  };
  std::optional<roam::draw::PictureFile> drawing;
  if (!options.picture.empty()) drawing.emplace(options.picture);
  std::vector<Rounds> all;
  for (const std::uint64_t triangles : options.galleries) {
    const auto meshes = roam::generate::collect(roam::generate::gallery({.triangles = triangles}));
    all.push_back({nullptr, std::make_shared<const roam::World>(roam::World::build(meshes)), {}, {}, {}, 0});
  }
  for (const std::string& name : options.stores) all.push_back({roam::Store::open(name), nullptr, {}, {}, {}, 0});
  for (int i = 0; i < options.rounds; ++i) {
    for (Rounds& one : all) {
      const Flight flight = one.store ? fly(options, one.store) : fly(options, *one.world, [](auto&&...) {});
      if (options.queries && i == 0) print_queries(flight, one.triangles());
      std::vector<double> times = flight.times;
      std::sort(times.begin(), times.end());
      one.steps = times.size();
      one.p50.push_back(1e-3 * quantile(times, 0.5));
      one.p99.push_back(1e-3 * quantile(times, 0.99));
      one.most.push_back(1e-3 * quantile(times, 1.0));
    }
  }
  std::vector<StepTimes> table;
  std::printf("%12s %8s %10s %10s %10s\n", "triangles", "steps", "median us", "p99 us", "max us");
  for (const Rounds& one : all) {
    table.push_back({one.triangles(), median(one.p50), median(one.p99)});
    std::printf("%12llu %8zu %10.2f %10.2f %10.2f\n", static_cast<unsigned long long>(table.back().triangles),
                one.steps, table.back().median_us, table.back().p99_us, median(one.most));
  }
  if (drawing) drawing->write(step_chart(table));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{
      "Times the steps of a flight along the first path of the gallery through stores of it (microseconds of the\n"
      "thread's own time, the median of the rounds), and draws a picture of them"};
  app.add_option("stores", options.stores, "stores of galleries of different sizes, made by `roam build`");
  app.add_option("--gallery", options.galleries, "triangles of galleries in memory");
  app.add_option("--memory", options.memory_mib, "MiB of each pager")->capture_default_str();
  app.add_option("--speed", options.speed, "speed of the flight, in metres per second")->capture_default_str();
  app.add_flag("--walk", options.walk, "a person of 1.8 m on foot, instead of a sphere of 0.3 m that flies");
  app.add_flag("--queries", options.queries, "count the queries of a step, which takes time");
  app.add_option("--rounds", options.rounds, "flights through each, in turns")
      ->capture_default_str()
      ->check(roam::app::at_least_one());
  app.add_option("--picture", options.picture, "a file to draw (.svg or .png)");
  return run_program(app, argc, argv, [&] { return run(options); });
}
