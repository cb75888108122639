// roam beside other engines, on the same queries in one run. Wrong answers come before times.

#include <benchmark/benchmark.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <string_view>

#include "engine.h"
#include "judge.h"
#include "query_sets.h"
#include "run_options.h"
#include "scene.h"
#include "timing.h"

namespace {

using namespace roam::bench;

struct Options : RunOptions {
  std::vector<std::string> engines;
  double patience = 1.0;  // s
};

// One engine on one set.
struct Run {
  const Engine* engine = nullptr;
  const QuerySet* set = nullptr;
  std::size_t queries = 0;  // fewer than the set has when the engine is too slow for all
  Verdict verdict;
  std::vector<bool> hits;  // by the reference
  Times times;
};

std::vector<std::string> engine_names() {
  std::vector<std::string> names;
  for (const auto& [name, make] : engines()) names.push_back(name);
  return names;
}

std::vector<Engine> build_engines(const Options& options, const Scene& scene) {
  std::vector<Engine> built;
  for (const auto& [name, make] : engines()) {
    const auto& wanted = options.engines;
    if (wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end()) built.push_back(make(scene));
  }
  return built;
}

// As many queries as the engine answers in the time that a round may take, at least a few.
Run judged(const Engine& engine, const QuerySet& set, const std::vector<Answer>& truth, const Reference& reference,
           double patience) {
  constexpr std::size_t fewest = 20;
  Run run{.engine = &engine, .set = &set, .verdict = {}, .hits = {}, .times = {}};
  std::vector<Answer> answers;
  const auto start = std::chrono::steady_clock::now();
  const auto end = start + std::chrono::duration<double>(patience);
  for (const Query& query : set.queries) {
    if (answers.size() >= fewest && std::chrono::steady_clock::now() > end) break;
    run.hits.push_back(truth[answers.size()].hit);
    answers.push_back(engine.sweep(query));
  }
  run.queries = answers.size();
  run.verdict = judge(answers, std::span(truth).first(run.queries), std::span(set.queries).first(run.queries),
                      reference, engine.says_when);
  return run;
}

void print_costs(std::FILE* out, const std::vector<Engine>& engines, const Scene& scene) {
  std::fprintf(out, "%-30s %10s %10s %10s   %s\n", "engine", "B/triangle", "build 1, s", "build 2, s", "used");
  for (const Engine& engine : engines) {
    std::fprintf(out, "%-30s %10.1f %10.3f ", engine.name.c_str(),
                 static_cast<double>(engine.bytes) / static_cast<double>(scene.triangles()), engine.build_one);
    if (engine.build_two > 0) {
      std::fprintf(out, "%10.3f", engine.build_two);
    } else {
      std::fprintf(out, "%10s", "-");
    }
    std::fprintf(out, "   %s\n", engine.used.c_str());
  }
  for (const std::string& name : absent_engines())
    std::fprintf(out, "%-30s not installed when this was built\n", name.c_str());
}

void print_wrong(std::FILE* out, const std::vector<Run>& runs) {
  std::fprintf(
      out, "\nwrong answers: missed or late by more than %g mm of depth, early or false by more than %g mm of gap\n",
      1e3 * depth_allowed, 1e3 * gap_allowed);
  std::fprintf(out, "%-9s %-30s %8s %8s %8s %8s %8s %8s %12s\n", "set", "engine", "queries", "hits", "missed", "late",
               "early", "false", "deepest, mm");
  for (const Run& run : runs) {
    const Verdict& v = run.verdict;
    std::fprintf(out, "%-9s %-30s %8zu %8zu %8zu ", run.set->name.c_str(), run.engine->name.c_str(), v.queries, v.hits,
                 v.missed);
    if (run.engine->says_when) {
      std::fprintf(out, "%8zu %8zu", v.late, v.early);
    } else {
      std::fprintf(out, "%8s %8s", "n/a", "n/a");
    }
    std::fprintf(out, " %8zu %12.3g\n", v.false_hits, 1e3 * v.deepest);
  }
  std::fprintf(out, "\n");
  std::fflush(out);
}

void time_set(std::span<Run> runs, int rounds) {
  std::vector<Ask> asked;
  std::vector<std::size_t> queries;
  for (const Run& run : runs) {
    asked.push_back(run.engine->ask);
    queries.push_back(run.queries);
  }
  std::vector<Times> times = time_in_turns(asked, queries, runs.front().set->queries, rounds);
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].times = std::move(times[i]);
}

// Google Benchmark sees each query's time as one iteration, and prints the figures beside their mean, in seconds.
void report(const Run& run) {
  const Summary summary = summarize(run.times, run.hits);
  benchmark::RegisterBenchmark((run.set->name + "/" + run.engine->name).c_str(),
                               [&run, summary](benchmark::State& state) {
                                 std::size_t i = 0;
                                 for ([[maybe_unused]] const auto iteration : state) {
                                   state.SetIterationTime(1e-9 * run.times[i++ % run.times.size()]);
                                 }
                                 constexpr double nano = 1e-9;
                                 state.counters["p50"] = nano * summary.p50;
                                 state.counters["p99"] = nano * summary.p99;
                                 state.counters["hit_p50"] = nano * summary.hit_p50;
                                 state.counters["max"] = nano * summary.most;
                                 state.counters["wrong"] = static_cast<double>(run.verdict.wrong());
                                 state.counters["missed"] = static_cast<double>(run.verdict.missed);
                                 state.counters["late"] = static_cast<double>(run.verdict.late);
                               })
      ->UseManualTime()
      ->Iterations(static_cast<benchmark::IterationCount>(run.times.size()))
      ->Unit(benchmark::kNanosecond);
}

void run(const Options& options, std::FILE* out) {
  const Scene scene = make_scene(options.scene);
  std::fprintf(out, "%s; %d interleaved rounds, medians\n\n", scene.name.c_str(), options.rounds);
  benchmark::AddCustomContext("scene", scene.name);
  const Reference reference(scene.meshes);
  const std::vector<Engine> built = build_engines(options, scene);
  print_costs(out, built, scene);
  for (const Engine& engine : built) {
    benchmark::AddCustomContext(
        engine.name + ", bytes a triangle",
        std::to_string(static_cast<double>(engine.bytes) / static_cast<double>(scene.triangles())));
    benchmark::AddCustomContext(engine.name + ", build on one thread, s", std::to_string(engine.build_one));
    if (engine.build_two > 0)
      benchmark::AddCustomContext(engine.name + ", build on two threads, s", std::to_string(engine.build_two));
  }

  std::vector<QuerySet> sets;
  for (const std::string& name : options.sets) sets.push_back(make_queries(name, options.queries, reference));
  std::vector<Run> runs;
  for (const QuerySet& set : sets) {
    std::vector<Answer> truth;
    for (const Query& query : set.queries) truth.push_back(reference.sweep(query));
    const bool capsules =
        std::any_of(set.queries.begin(), set.queries.end(), [](const Query& q) { return q.body.half_height > 0; });
    for (const Engine& engine : built) {
      if (!(capsules && engine.spheres_only)) runs.push_back(judged(engine, set, truth, reference, options.patience));
    }
  }
  print_wrong(out, runs);

  for (auto first = runs.begin(); first != runs.end();) {
    const auto last = std::find_if(first, runs.end(), [&](const Run& r) { return r.set != first->set; });
    time_set({first, last}, options.rounds);
    first = last;
  }
  for (const Run& r : runs) report(r);
  benchmark::RunSpecifiedBenchmarks();
}

}  // namespace

int main(int argc, char** argv) {
  // Google Benchmark's arguments and ours; each would refuse, or answer for, the other's.
  std::string tabular = "--benchmark_counters_tabular=true";
  std::vector<char*> for_benchmark{argv[0], tabular.data()};
  std::vector<char*> ours{argv[0]};
  std::FILE* out = stdout;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    (argument.starts_with("--benchmark_") ? for_benchmark : ours).push_back(argv[i]);
    // A format for programs has standard output to itself.
    if (argument.starts_with("--benchmark_format=") && !argument.ends_with("=console")) out = stderr;
  }
  int count = static_cast<int>(for_benchmark.size());
  benchmark::Initialize(&count, for_benchmark.data());
  if (benchmark::ReportUnrecognizedArguments(count, for_benchmark.data())) return 2;

  Options options;
  CLI::App app{"Sweeps through one scene: roam beside other engines"};
  app.footer(
      "Google Benchmark's options --benchmark_format=json, --benchmark_out=FILE, --benchmark_filter=REGEX, ... work "
      "too.");
  options.add_to(app);
  app.add_option("--engines", options.engines, "which engines, separated by commas; all when left out")
      ->delimiter(',')
      ->check(CLI::IsMember(engine_names()));
  app.add_option("--patience", options.patience,
                 "seconds: an engine that needs longer for a set gets the first part of it")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  CLI11_PARSE(app, static_cast<int>(ours.size()), ours.data());
  try {
    run(options, out);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
