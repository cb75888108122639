// roam bench engines: roam and other engines, on the same queries in one run.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <optional>

#include "bench_verbs.h"
#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/report.h"
#include "cli/values.h"
#include "comparison.h"
#include "draw/picture_file.h"
#include "engines_report.h"
#include "roam/error.h"
#include "run_options.h"

namespace roam::bench {
namespace {

struct Options : RunOptions {
  std::vector<std::string> engines;
  EnginePlaces places;
  ComparisonOptions comparison;
  std::string picture;
  bool json = false;
};

void note(const std::string& text) { fmt::print(stderr, "{}\n", text); }

/// The requested engines. Throws if none of them is installed.
std::vector<EngineOffer> chosen_engines(const Options& options) {
  std::vector<EngineOffer> offers = engine_offers(options.places);
  const auto& wanted = options.engines;
  std::erase_if(offers, [&](const EngineOffer& offer) {
    return !wanted.empty() && std::find(wanted.begin(), wanted.end(), offer.name) == wanted.end();
  });
  if (std::any_of(offers.begin(), offers.end(), [](const EngineOffer& offer) { return offer.make != nullptr; })) {
    return offers;
  }
  std::string why = "none of the chosen engines is installed";
  for (const EngineOffer& offer : offers) why += "; " + offer.name + ": " + offer.missing;
  throw Error(why);
}

SceneFindings find_in(const SceneChoice& choice, const std::vector<EngineOffer>& offers, const Options& options) {
  SceneFindings findings;
  const Scene scene = make_scene(choice, [] { return !app::interrupted(); });
  findings.scene = scene.name;
  findings.triangles = scene.triangles();
  note(scene.name);
  const Reference reference(scene.meshes);
  for (const EngineOffer& offer : offers) {
    if (!offer.make) continue;
    app::stop_if_interrupted();
    note("building " + offer.name);
    try {
      findings.engines.push_back(offer.make(scene));
    } catch (const Error& error) {
      findings.failed.push_back({offer.name, {}, error.what()});
    }
  }
  if (findings.engines.empty()) {
    throw Error(findings.failed.front().name + " failed while it was built: " + findings.failed.front().why);
  }
  for (const std::string& name : options.sets) {
    note("asking " + name);
    const QuerySet set = make_queries(name, options.queries, reference);
    for (EngineRun& run : compare(findings.engines, set, reference, options.comparison)) {
      if (run.failure.empty()) {
        findings.runs.push_back(std::move(run));
      } else {
        findings.failed.push_back({run.engine->name, run.set, run.failure});
      }
    }
  }
  for (Engine& engine : findings.engines) engine.ask = engine.nearest = {};  // frees the scene
  return findings;
}

EngineFindings find(const Options& options) {
  const std::vector<EngineOffer> offers = chosen_engines(options);
  EngineFindings findings{.rounds = options.comparison.rounds, .scenes = {}, .absent = offers};
  std::erase_if(findings.absent, [](const EngineOffer& offer) { return offer.make != nullptr; });
  for (const SceneChoice& choice : options.scenes) findings.scenes.push_back(find_in(choice, offers, options));
  return findings;
}

app::ExitStatus run(const Options& options) {
  const std::vector<std::filesystem::path> scenes(options.scene_names().begin(), options.scene_names().end());
  if (!options.picture.empty()) app::check_output("--picture", options.picture);
  const app::NamedFile drawn{"--picture", options.picture};
  app::demand_no_overwriting(app::named_scenes(scenes), {&drawn, 1});
  std::optional<draw::PictureFile> drawing;
  if (!options.picture.empty()) drawing.emplace(options.picture);
  const EngineFindings findings = find(options);
  if (options.json) {
    app::print(engine_json(findings));
  } else {
    app::print(engine_tables(findings));
  }
  if (drawing) drawing->write(engine_chart(findings));
  return engine_status(findings);
}

constexpr const char* help =
    "Missing engines are named, with the package to install. PhysX, Jolt and Box3D are in no package: build them, and\n"
    "roam with -DROAM_PHYSX_DIR, -DJolt_DIR and -Dbox3d_DIR. PhysX and Jolt also run under node, as WebAssembly and\n"
    "slower, and so does three-mesh-bvh:\n"
    "  npm install --prefix DIR physx-js-webidl jolt-physics three three-mesh-bvh\n\n"
    "Rays and nearest points have a table of their own, of the engines that have such queries.\n\n"
    "At the end: how many times as fast as the fastest other engine roam is, in each row of sweeps and figure, the\n"
    "geometric means, and the worst rows.\n\n"
    "Exit status 3: roam itself missed something or stopped late; 1: also when roam itself failed.\n\n"
    "Examples:\n"
    "  roam bench engines\n"
    "  roam bench engines --scene your/own/file.ive --picture engines.svg\n"
    "  roam bench engines --scene gallery --scene terrain:1M --engines roam,embree,fcl --json\n";

}  // namespace

void add_engines(CLI::App& program, app::Run& run) {
  CLI::App* verb = program.add_subcommand("engines", "Sweeps through scenes: roam beside other engines");
  verb->footer(help);
  const auto options = std::make_shared<Options>();
  options->add_to(*verb, point_set_names());
  verb->add_option("--engines", options->engines, "Engines, separated by commas (default: all)")
      ->delimiter(',')
      ->check(app::one_of(engine_names()));
  verb->add_option("--wasm-engines", options->places.wasm, "Folder with PhysX, Jolt and three-mesh-bvh in node_modules")
      ->type_name("DIR");
  verb->add_option("--patience", options->comparison.patience,
                   "Seconds for a set of queries; a slower engine answers its first part only")
      ->capture_default_str()
      ->check(app::positive());
  verb->add_option("--picture", options->picture, "Draw the times as bars (.svg or .png)")->type_name("FILE");
  verb->add_flag("--json", options->json, "Print one JSON object");
  verb->callback([options, &run] {
    options->comparison.rounds = options->rounds;
    options->comparison.between = app::stop_if_interrupted;
    run = [options] { return bench::run(*options); };
  });
}

}  // namespace roam::bench
