// Times the steps of persons who push into the walls of a scene: the hardest steps there are.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "program.h"
#include "roam/import.h"
#include "roam/walker.h"
#include "roam/world.h"
#include "thread_clock.h"
#include "timing.h"

namespace {

using namespace roam::bench;
using roam::Vec3;

constexpr double two_pi = 6.283185307179586;
constexpr int steps_each = 600;       ///< 10 s
constexpr int most_places = 100'000;  ///< tried for all persons together

struct Options {
  std::string scene, up = "z";
  double foot = 0.5, radius = 0.3, height = 1.6;
  int persons = 40;
};

int run(const Options& options) {
  roam::ImportOptions how;
  how.up = roam::parse_up_axis(options.up);
  const roam::World world = roam::World::build(roam::import_scene(options.scene, how).meshes);
  const roam::WalkerSettings settings{
      .radius = options.radius, .support_radius = options.foot, .height = options.height};
  const roam::Box box = world.bounds();
  const double reading = cost_of_reading();
  std::mt19937_64 random(5);
  const auto part = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<double> times;
  std::size_t blocked = 0, bridging = 0;
  int persons = 0;
  for (int place = 0; place < most_places && persons < options.persons; ++place) {
    const Vec3 at = box.lower + Vec3(part(), part(), 0.0) * box.size() + Vec3(0.0, 0.0, 0.75 * options.height);
    roam::Walker walker(world, settings, roam::Mode::walk, at);
    if (walker.report().held) continue;
    ++persons;
    const double heading = two_pi * part();
    for (int i = 0; i < steps_each && !walker.report().held; ++i) {
      const double h = heading + 0.3 * std::sin(0.02 * i);
      const double begin = thread_time();
      const roam::StepReport& report = walker.step({.velocity = 1.4 * Vec3(std::cos(h), std::sin(h), 0.0)}, 1.0 / 60.0);
      times.push_back(1e-3 * std::max(0.0, thread_time() - begin - reading));
      blocked += report.blocked;
      bridging += report.bridging;
    }
  }
  std::sort(times.begin(), times.end());
  std::printf("%d persons, %zu steps: %zu blocked, %zu on the support disc\n", persons, times.size(), blocked,
              bridging);
  std::printf("%10s %10s %10s %10s\n", "median us", "p99 us", "p99.9 us", "max us");
  std::printf("%10.1f %10.1f %10.1f %10.1f\n", quantile(times, 0.5), quantile(times, 0.99), quantile(times, 0.999),
              quantile(times, 1.0));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"Times the steps of persons who push into the walls of a scene (microseconds of the thread's own time)"};
  app.add_option("scene", options.scene, "a scene file")->required();
  app.add_option("--up", options.up, "the axis that points up: x, y, z, -x, -y or -z")->capture_default_str();
  app.add_option("--support-radius", options.foot, "radius of the support disc, metres")->capture_default_str();
  app.add_option("--radius", options.radius, "radius of the body, metres")->capture_default_str();
  app.add_option("--height", options.height, "height of the body, metres")->capture_default_str();
  app.add_option("--persons", options.persons, "number of persons")->capture_default_str();
  return run_program(app, argc, argv, [&] { return run(options); });
}
