// roam bench scale: the times of a sweep, a clearance and a step in the same gallery, with more and more triangles.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench_verbs.h"
#include "charts.h"
#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/report.h"
#include "cli/values.h"
#include "draw/picture_file.h"
#include "paper_scene.h"
#include "roam/error.h"
#include "roam/generate.h"
#include "roam/pager.h"
#include "roam/route.h"
#include "roam/store_build.h"
#include "roam/world.h"
#include "timing.h"

namespace roam::bench {
namespace {

using app::Json;

struct Options {
  std::uint64_t triangles = 1'000'000;
  std::uint64_t least = 100'000;
  double memory_gib = 4.0;
  std::uint64_t pager_mib = 64;
  double speed = 50.0;
  int rounds = 3;
  std::string scratch, picture;
  bool json = false;
};

// During a build, both the meshes and the index are in memory.
constexpr double building_bytes = 60.0;  // a triangle
constexpr double radius = 0.3;           // m

/// One size of the scene.
struct Size {
  std::uint64_t triangles = 0;
  std::shared_ptr<const Space> space;
  std::shared_ptr<Pager> pager;  // null if everything is in memory
  double build_s = 0.0;
  std::uint64_t bytes = 0;  // needed by queries
};

/// The timed part of each step of a flight.
enum class What : std::uint8_t { sweep, clearance, step };
constexpr std::array<What, 3> all_of_it{What::sweep, What::clearance, What::step};
constexpr const char* to_string(What what) {
  return what == What::sweep ? "sweep" : what == What::clearance ? "clearance" : "step";
}

/// Medians over the rounds, microseconds.
struct Times {
  double p50 = 0.0, p99 = 0.0;
};
struct Row {
  const Size* size = nullptr;
  std::size_t steps = 0;
  std::array<Times, all_of_it.size()> times;
};

Size make_size(std::uint64_t triangles, const Options& options, const std::string& folder) {
  app::stop_if_interrupted();
  const auto goes_on = [](const auto&) { return !app::interrupted(); };
  const generate::Scene gallery = generate::gallery({.triangles = triangles});
  Size size{.triangles = gallery.triangles(), .space = {}, .pager = {}};
  const auto start = std::chrono::steady_clock::now();
  const auto passed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  fmt::print(stderr, "making {} triangles\n", size.triangles);
  if (static_cast<double>(size.triangles) * building_bytes <= options.memory_gib * (1 << 30)) {
    const std::vector<Mesh> meshes = generate::collect(gallery, goes_on);
    const double made = passed();
    BuildOptions build;
    build.progress = goes_on;
    const auto world = std::make_shared<World>(World::build(meshes, build));
    size.build_s = passed() - made;
    size.bytes = world->stats().bytes;
    size.space = world;
    return size;
  }
  const std::string file = fmt::format("{}/{}.ply", folder, triangles);
  generate::write_scene(gallery, file, goes_on);
  StoreBuildOptions build;
  build.scene = {file};
  build.output = fmt::format("{}/{}.roam", folder, triangles);
  build.progress = goes_on;
  const double made = passed();
  build_store(build);
  size.build_s = passed() - made;
  std::filesystem::remove(file);
  size.pager = std::make_shared<Pager>(Store::open(build.output), PagerOptions{.memory = options.pager_mib << 20});
  size.bytes = size.pager->stats().memory;
  size.space = size.pager;
  return size;
}

/// One flight along the paper's first path. Returns the nanoseconds of each step.
std::vector<double> fly(const Size& size, What what, double speed) {
  const generate::Path& path = generate::gallery_paths[0];
  const WalkerSettings settings = WalkerSettings::sphere(radius);
  const Body body{.radius = radius};
  constexpr double longest_wait = 60.0;  // s, for the surroundings of the start
  if (size.pager) (void)size.pager->wait(body, path.from, Vec3(0.0), longest_wait);
  Walker walker(*size.space, settings, Mode::fly, path.from);
  const std::vector<Vec3> way{path.from, path.to};
  Route route(walker, way, {.speed = speed});
  const Vec3 motion = glm::normalize(path.to - path.from) * speed / 60.0;
  std::vector<double> times;
  double unused = 0.0;
  while (!route.done()) {
    app::stop_if_interrupted();
    const Vec3 place = walker.position();
    const std::uint64_t before = clock_before();
    if (what == What::sweep) unused += size.space->sweep(body, place, motion).time;
    if (what == What::clearance) unused += size.space->clearance(body, place, motion, 1.0).distance;
    if (what == What::step) route.advance();
    times.push_back(static_cast<double>(clock_after() - before));
    if (what != What::step) route.advance();
    const double rest = walker.report().elapsed;
    if (size.pager) (void)size.pager->wait(walker.body(), walker.position(), walker.velocity(), rest);
  }
  if (route.result().outcome != Outcome::reached || !std::isfinite(unused)) {
    throw Error("the flight along path 1 did not reach its end");
  }
  to_nanoseconds(times);
  return times;
}

std::vector<Row> measure(const std::vector<Size>& sizes, const Options& options) {
  std::vector<Row> rows;
  for (const Size& size : sizes) rows.push_back({.size = &size, .steps = 0, .times = {}});
  for (std::size_t w = 0; w < all_of_it.size(); ++w) {
    std::vector<std::vector<Times>> rounds(sizes.size());
    for (int round = 0; round < options.rounds; ++round) {
      for (std::size_t i = 0; i < sizes.size(); ++i) {
        std::vector<double> times = fly(sizes[i], all_of_it[w], options.speed);
        std::sort(times.begin(), times.end());
        rounds[i].push_back({1e-3 * quantile(times, 0.5), 1e-3 * quantile(times, 0.99)});
        rows[i].steps = times.size();
      }
    }
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      std::vector<double> p50, p99;
      for (const Times& t : rounds[i]) {
        p50.push_back(t.p50);
        p99.push_back(t.p99);
      }
      rows[i].times[w] = {median(p50), median(p99)};
    }
  }
  return rows;
}

std::string table(const std::vector<Row>& rows, const Options& options) {
  std::string out =
      fmt::format("a sphere of {:g} m along the gallery's first path at {:g} m/s; us, medians over rounds: {}\n\n",
                  radius, options.speed, options.rounds);
  out += fmt::format("{:>12} {:<7} {:>9} {:>10} {:>11} {:>7}", "triangles", "where", "build, s", "MiB", "B/triangle",
                     "steps");
  for (const What what : all_of_it) out += fmt::format(" {:>21}", fmt::format("{} p50 / p99", to_string(what)));
  out += "\n";
  for (const Row& row : rows) {
    const Size& size = *row.size;
    const double bytes = static_cast<double>(size.bytes);
    out +=
        fmt::format("{:>12} {:<7} {:>9.3g} {:>10.1f} {:>11.2f} {:>7}", size.triangles, size.pager ? "store" : "memory",
                    size.build_s, bytes / (1 << 20), bytes / static_cast<double>(size.triangles), row.steps);
    for (const Times& t : row.times) out += fmt::format(" {:>21}", fmt::format("{:.3g} / {:.3g}", t.p50, t.p99));
    out += "\n";
  }
  if (rows.size() < 2) return out;
  out += "\nfrom the first to the last, p50:";
  for (std::size_t w = 0; w < all_of_it.size(); ++w) {
    out += fmt::format(" {} x{:.2f}", to_string(all_of_it[w]), rows.back().times[w].p50 / rows.front().times[w].p50);
  }
  return out + "\n";
}

Json to_json(const std::vector<Row>& rows, const Options& options) {
  Json sizes = Json::array();
  for (const Row& row : rows) {
    Json one{{"triangles", row.size->triangles},
             {"in_memory", row.size->pager == nullptr},
             {"build_s", row.size->build_s},
             {"bytes", row.size->bytes},
             {"steps", row.steps}};
    for (std::size_t w = 0; w < all_of_it.size(); ++w) {
      one[to_string(all_of_it[w])] = {{"p50_us", row.times[w].p50}, {"p99_us", row.times[w].p99}};
    }
    sizes.push_back(std::move(one));
  }
  return {{"rounds", options.rounds}, {"speed", options.speed}, {"radius", radius}, {"sizes", sizes}};
}

app::ExitStatus run(const Options& options) {
  if (options.least > options.triangles) throw app::UsageError("--least is larger than --triangles");
  if (!options.picture.empty()) app::check_output("--picture", options.picture);
  std::optional<draw::PictureFile> drawing;
  if (!options.picture.empty()) drawing.emplace(options.picture);
  const ScratchFolder scratch(options.scratch);
  std::vector<Size> sizes;
  for (std::uint64_t n = options.least; n < options.triangles; n *= 10) {
    sizes.push_back(make_size(n, options, scratch.path()));
  }
  sizes.push_back(make_size(options.triangles, options, scratch.path()));
  const std::vector<Row> rows = measure(sizes, options);
  if (options.json) {
    app::print(to_json(rows, options));
  } else {
    app::print(table(rows, options));
  }
  if (drawing) {
    std::vector<StepTimes> curve;
    for (const Row& row : rows) curve.push_back({row.size->triangles, row.times[2].p50, row.times[2].p99});
    drawing->write(step_chart(curve));
  }
  return app::done;
}

constexpr const char* help =
    "Sizes are powers of ten from --least, and --triangles. Scenes that can be built in --memory are worlds in\n"
    "memory; larger ones become stores in the scratch folder.\n"
    "A sphere of 0.3 m flies along the gallery's first path, in turns for sweeps, clearances and steps.\n\n"
    "Examples:\n"
    "  roam bench scale --triangles 10M\n"
    "  roam bench scale --triangles 100M --memory 8 --scratch /big/disk --picture scale.svg\n";

}  // namespace

void add_scale(CLI::App& program, app::Run& run) {
  CLI::App* verb = program.add_subcommand("scale", "The time of a sweep and of a step by the size of the scene");
  verb->footer(help);
  const auto options = std::make_shared<Options>();
  app::add_triangles(*verb, "--triangles", options->triangles, "Triangles of the largest scene");
  app::add_triangles(*verb, "--least", options->least, "Triangles of the smallest");
  verb->add_option("--memory", options->memory_gib, "GiB for building a world in memory")
      ->capture_default_str()
      ->check(app::positive());
  verb->add_option("--pager", options->pager_mib, "MiB of each pager")
      ->capture_default_str()
      ->check(app::from_to<std::uint64_t>(Pager::least_memory >> 20, 1u << 20));
  verb->add_option("--speed", options->speed, "Speed of the flight, in metres per second")
      ->capture_default_str()
      ->check(app::from_to(0.1, 1e4));
  verb->add_option("--rounds", options->rounds, "Flights of each kind through each scene; medians are shown")
      ->capture_default_str()
      ->check(app::at_least_one());
  verb->add_option("--scratch", options->scratch, "Folder for stores (default: the system's temporary folder)")
      ->type_name("DIR");
  verb->add_option("--picture", options->picture, "Draw the steps' times by size (.svg or .png)")->type_name("FILE");
  verb->add_flag("--json", options->json, "Print one JSON object");
  verb->callback([options, &run] { run = [options] { return bench::run(*options); }; });
}

}  // namespace roam::bench
