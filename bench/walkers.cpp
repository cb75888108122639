// roam bench walkers: controllers side by side on the first way of the paper. Where they came into walls comes before
// times.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench_verbs.h"
#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/report.h"
#include "cli/values.h"
#include "controllers.h"
#include "draw/picture_file.h"
#include "paper_movers.h"
#include "roam/error.h"
#include "roam/generate.h"
#include "walkers_report.h"

namespace roam::bench {
namespace {

struct Options {
  std::vector<std::string> controllers;
  std::string wasm, picture;
  std::uint64_t triangles = 500'000;
  double patience = 60.0;
  int rounds = 3;
  bool json = false;
};

std::vector<std::string> controller_names() {
  std::vector<std::string> names;
  for (const Controller& controller : controllers({})) names.push_back(controller.name);
  return names;
}

/// The gallery at a place where floats are precise: the same for all, roam too.
Scene shifted_gallery(std::uint64_t triangles) {
  Scene scene;
  scene.meshes =
      generate::collect(generate::gallery({.triangles = triangles}), [](std::uint64_t) { return !app::interrupted(); });
  for (Mesh& mesh : scene.meshes) {
    for (Vec3& vertex : mesh.vertices) vertex += paper_shift;
  }
  scene.name = fmt::format("gallery, {} triangles", scene.triangles());
  return scene;
}

std::vector<Controller> chosen(const Options& options) {
  std::vector<Controller> all = controllers(options.wasm);
  std::erase_if(all, [&](const Controller& controller) {
    const auto& wanted = options.controllers;
    return !wanted.empty() && std::find(wanted.begin(), wanted.end(), controller.name) == wanted.end();
  });
  if (std::any_of(all.begin(), all.end(), [](const Controller& one) { return one.load != nullptr; })) return all;
  std::string why = "none of the chosen controllers is here";
  for (const Controller& controller : all) why += fmt::format("; {}: {}", controller.name, controller.missing);
  throw Error(why);
}

WalkerFindings find(const Options& options) {
  WalkerFindings findings{.scene = {}, .rounds = options.rounds, .walks = {}, .absent = {}, .failed = {}};
  const std::vector<Controller> all = chosen(options);
  const Scene scene = shifted_gallery(options.triangles);
  findings.scene = scene.name;
  struct Loaded {
    Controller controller;
    Mover mover;
  };
  std::vector<Loaded> loaded;
  for (const Controller& controller : all) {
    if (!controller.load) {
      findings.absent.push_back(controller);
      continue;
    }
    app::stop_if_interrupted();
    fmt::print(stderr, "loading {}\n", controller.name);
    try {
      loaded.push_back({controller, controller.load(scene)});
    } catch (const Error& error) {
      findings.failed.push_back({controller.name, error.what()});
    }
  }
  PaperJudge judge;
  for (const Way& way : walkers_ways(paper_shift)) {
    fmt::print(stderr, "{}\n", way.name);
    const std::size_t first = findings.walks.size();
    for (const Loaded& one : loaded) {
      findings.walks.push_back({.way = way.name, .controller = one.controller.name, .used = one.controller.used});
    }
    for (int round = 0; round < options.rounds; ++round) {
      for (std::size_t i = 0; i < loaded.size(); ++i) {
        app::stop_if_interrupted();
        const Walked walked = walk(loaded[i].mover, way, options.patience);
        findings.walks[first + i].add(walked);
        if (round == 0) judge.watch(way, walked);
      }
    }
  }
  fmt::print(stderr, "judging\n");
  for (const Mesh& mesh : scene.meshes) judge.add(mesh);
  const std::vector<Judgement> judged = judge.judgements();
  for (std::size_t i = 0; i < judged.size(); ++i) findings.walks[i].judged = judged[i];
  return findings;
}

app::ExitStatus run(const Options& options) {
  if (!options.picture.empty()) app::check_output("--picture", options.picture);
  std::optional<draw::PictureFile> drawing;
  if (!options.picture.empty()) drawing.emplace(options.picture);
  const WalkerFindings findings = find(options);
  if (options.json) {
    app::print(walkers_json(findings));
  } else {
    app::print(walkers_tables(findings));
  }
  if (drawing) drawing->write(walkers_chart(findings));
  return walkers_status(findings);
}

constexpr const char* help =
    "The way is the paper's first, 1.8 km through its gallery: a person of 0.3 m x 1.8 m on foot at 1.4 m/s and at\n"
    "50 m/s, and a sphere of 0.3 m that flies at 1.4 m/s; 60 steps a second. A time is that of a whole step.\n"
    "Missing controllers are named, with the package to install; see `roam bench engines --help`.\n\n"
    "Exit status 3: roam itself was in a wall; 1: also when roam itself failed.\n\n"
    "Examples:\n"
    "  roam bench walkers\n"
    "  roam bench walkers --wasm-engines DIR --picture walkers.svg --json\n";

}  // namespace

void add_walkers(CLI::App& program, app::Run& run) {
  CLI::App* verb =
      program.add_subcommand("walkers", "Steps through the paper's gallery: roam beside other controllers");
  verb->footer(help);
  const auto options = std::make_shared<Options>();
  app::add_triangles(*verb, "--triangles", options->triangles, "Triangles of the made gallery", 50'000);
  verb->add_option("--controllers", options->controllers, "Controllers, separated by commas (default: all)")
      ->delimiter(',')
      ->check(app::one_of(controller_names()));
  verb->add_option("--wasm-engines", options->wasm, "Folder with PhysX and Jolt in node_modules")->type_name("DIR");
  verb->add_option("--rounds", options->rounds, "Walks of each, in turns; figures are medians over them")
      ->capture_default_str()
      ->check(app::at_least_one());
  verb->add_option("--patience", options->patience, "Seconds after which a walk is ended")
      ->capture_default_str()
      ->check(app::positive());
  verb->add_option("--picture", options->picture, "Draw the steps' times as bars (.svg or .png)")->type_name("FILE");
  verb->add_flag("--json", options->json, "Print one JSON object");
  verb->callback([options, &run] { run = [options] { return bench::run(*options); }; });
}

}  // namespace roam::bench
