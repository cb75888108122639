// Compares roam with other engines, on the same queries in one run. Wrong answers come before times.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench_verbs.h"
#include "charts.h"
#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/report.h"
#include "cli/values.h"
#include "comparison.h"
#include "draw/picture_file.h"
#include "roam/error.h"
#include "run_options.h"

namespace roam::bench {
namespace {

using app::Json;

struct Options : RunOptions {
  std::vector<std::string> engines;
  EnginePlaces places;
  ComparisonOptions comparison;
  std::string picture;
  bool json = false;
};

/// A failure of an engine while it was built or queried.
struct Failure {
  std::string name, set, why;  // the set is empty while it is built
};

/// The results of a run.
struct Findings {
  std::string scene;
  std::uint64_t triangles = 0;
  std::vector<Engine> engines;
  std::vector<EngineOffer> absent;
  std::vector<Failure> failed;
  std::vector<EngineRun> runs;
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

Findings find(const Options& options) {
  const std::vector<EngineOffer> offers = chosen_engines(options);
  Findings findings;
  const Scene scene = make_scene(options.scene, [] { return !app::interrupted(); });
  findings.scene = scene.name;
  findings.triangles = scene.triangles();
  note(scene.name);
  const Reference reference(scene.meshes);
  for (const EngineOffer& offer : offers) {
    if (!offer.make) {
      findings.absent.push_back(offer);
      continue;
    }
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
  return findings;
}

double bytes_a_triangle(const Engine& engine, const Findings& findings) {
  return static_cast<double>(engine.bytes) / static_cast<double>(findings.triangles);
}

std::string or_dash(bool there, const std::string& text) { return there ? text : "-"; }

std::string table(const Findings& findings, int rounds) {
  std::string out = fmt::format("{}; {} interleaved rounds, medians; us\n\n", findings.scene, rounds);
  out +=
      fmt::format("wrong: missed or late by more than {:g} mm of depth, early or false by more than {:g} mm of gap\n",
                  1e3 * depth_allowed, 1e3 * gap_allowed);
  out += fmt::format("{:<9} {:<27} {:>8} {:>7} {:>7} {:>7} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "set", "engine",
                     "queries", "missed", "late", "early", "false", "deepest", "p50", "p99", "max", "hit p50");
  std::string last;
  for (const EngineRun& run : findings.runs) {
    if (!last.empty() && last != run.set) out += "\n";
    last = run.set;
    const Verdict& v = run.verdict;
    const bool when = run.engine->says_when;
    out += fmt::format("{:<9} {:<27} {:>8} {:>7} {:>7} {:>7} {:>7} {:>9} {:>9.3g} {:>9.3g} {:>9.3g} {:>9.3g}\n",
                       run.set, run.engine->name, run.asked, v.missed, or_dash(when, std::to_string(v.late)),
                       or_dash(when, std::to_string(v.early)), v.false_hits,
                       or_dash(v.deepest > 0, fmt::format("{:.3g} mm", 1e3 * v.deepest)), 1e-3 * run.times.p50,
                       1e-3 * run.times.p99, 1e-3 * run.times.most, 1e-3 * run.times.hit_p50);
  }
  out +=
      fmt::format("\n{:<27} {:>10} {:>10} {:>10}   {}\n", "engine", "B/triangle", "build 1, s", "build 2, s", "used");
  for (const Engine& engine : findings.engines) {
    out += fmt::format("{:<27} {:>10} {:>10.3f} {:>10}   {}\n", engine.name,
                       or_dash(engine.bytes > 0, fmt::format("{:.1f}", bytes_a_triangle(engine, findings))),
                       engine.build_one, or_dash(engine.build_two > 0, fmt::format("{:.3f}", engine.build_two)),
                       engine.used);
  }
  for (const Failure& failure : findings.failed) {
    out += fmt::format("{:<27} failed while it was {}: {}\n", failure.name,
                       failure.set.empty() ? "built" : "asked " + failure.set, failure.why);
  }
  for (const EngineOffer& offer : findings.absent) {
    out += fmt::format("{:<27} not here: {}\n", offer.name, offer.missing);
  }
  return out;
}

Json to_json(const EngineRun& run) {
  const Verdict& v = run.verdict;
  return {{"set", run.set},
          {"engine", run.engine->name},
          {"queries", run.asked},
          {"hits", v.hits},
          {"missed", v.missed},
          {"late", v.late},
          {"early", v.early},
          {"false", v.false_hits},
          {"says_when", run.engine->says_when},
          {"deepest_m", v.deepest},
          {"mean_us", 1e-3 * run.times.mean},
          {"p50_us", 1e-3 * run.times.p50},
          {"p99_us", 1e-3 * run.times.p99},
          {"max_us", 1e-3 * run.times.most},
          {"hit_p50_us", 1e-3 * run.times.hit_p50}};
}

Json to_json(const Findings& findings, int rounds) {
  Json engines = Json::array(), absent = Json::array(), failed = Json::array(), runs = Json::array();
  for (const Engine& engine : findings.engines) {
    Json one{{"engine", engine.name},
             {"used", engine.used},
             {"bytes", engine.bytes},
             {"bytes_a_triangle", bytes_a_triangle(engine, findings)},
             {"build_one_thread_s", engine.build_one}};
    if (engine.build_two > 0) one["build_two_threads_s"] = engine.build_two;
    engines.push_back(one);
  }
  for (const EngineOffer& offer : findings.absent)
    absent.push_back({{"engine", offer.name}, {"missing", offer.missing}});
  for (const Failure& f : findings.failed) failed.push_back({{"engine", f.name}, {"set", f.set}, {"why", f.why}});
  for (const EngineRun& run : findings.runs) runs.push_back(to_json(run));
  return {{"scene", findings.scene},
          {"triangles", findings.triangles},
          {"rounds", rounds},
          {"depth_allowed_m", depth_allowed},
          {"gap_allowed_m", gap_allowed},
          {"engines", engines},
          {"absent", absent},
          {"failed", failed},
          {"runs", runs}};
}

draw::Sheet drawn(const Findings& findings) {
  std::vector<BarGroup> groups;
  for (const EngineRun& run : findings.runs) {
    if (groups.empty() || groups.back().title != run.set) groups.push_back({run.set, {}});
    const std::size_t wrong = run.verdict.missed + run.verdict.late;
    groups.back().bars.push_back(
        {.name = run.engine->name,
         .p50 = 1e-3 * run.times.p50,
         .p99 = 1e-3 * run.times.p99,
         .note =
             wrong == 0 ? "" : fmt::format("({:.2g} % missed or late)", 100.0 * static_cast<double>(wrong) / run.asked),
         .stressed = run.engine->name == "roam"});
  }
  return bar_chart("Sweeps, " + findings.scene, groups);
}

app::ExitStatus run(const Options& options) {
  const std::filesystem::path scene = options.scene.scene;
  if (!options.picture.empty()) app::check_output({&scene, 1}, "--picture", options.picture);
  std::optional<draw::PictureFile> drawing;
  if (!options.picture.empty()) drawing.emplace(options.picture);
  const Findings findings = find(options);
  if (options.json) {
    app::print(to_json(findings, options.comparison.rounds));
  } else {
    app::print(table(findings, options.comparison.rounds));
  }
  if (drawing) drawing->write(drawn(findings));
  if (std::any_of(findings.failed.begin(), findings.failed.end(), [](const Failure& f) { return f.name == "roam"; })) {
    return app::failed;
  }
  const bool wrong = std::any_of(findings.runs.begin(), findings.runs.end(), [](const EngineRun& run) {
    return run.engine->name == "roam" && run.verdict.missed + run.verdict.late > 0;
  });
  return wrong ? app::answer_no : app::done;
}

constexpr const char* help =
    "Missing engines are named, with the package to install. PhysX and Jolt come from npm as WebAssembly and run\n"
    "under node, slower than their native builds:\n"
    "  npm install --prefix DIR physx-js-webidl jolt-physics\n\n"
    "Exit status 3: roam itself missed something or stopped late; 1: also when roam itself failed.\n\n"
    "Examples:\n"
    "  roam bench engines\n"
    "  roam bench engines --scene your/own/file.ive --picture engines.svg\n"
    "  roam bench engines --scene terrain --triangles 1000000 --engines roam,embree,fcl --json\n";

}  // namespace

void add_engines(CLI::App& program, app::Run& run) {
  CLI::App* verb = program.add_subcommand("engines", "Sweeps through one scene: roam beside other engines");
  verb->footer(help);
  const auto options = std::make_shared<Options>();
  options->add_to(*verb);
  verb->add_option("--engines", options->engines, "Engines, separated by commas (default: all)")
      ->delimiter(',')
      ->check(app::one_of(engine_names()));
  verb->add_option("--wasm-engines", options->places.wasm, "Folder with PhysX and Jolt in node_modules")
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
