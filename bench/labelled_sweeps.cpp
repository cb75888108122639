// roam bench labels: writes sweeps with exact answers, and judges the answers of any engine to them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bench_verbs.h"
#include "cli/exit_status.h"
#include "cli/output_file.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/values.h"
#include "files/whole_file.h"
#include "labels.h"
#include "roam/error.h"

namespace roam::bench {
namespace {

using app::Json;

struct Options {
  std::string file, answers;
  std::uint64_t count = 1'000'000, seed = 1;
  bool json = false;
};

using Scores = std::array<LabelScore, kind_count>;

/// The numbers of a file, one for each sweep, in their order.
std::vector<double> read_answers(const std::string& file, std::size_t count) {
  constexpr std::uint64_t most_bytes = std::uint64_t{1} << 34;
  const std::string text = files::read_named(file, most_bytes);
  std::vector<double> answers;
  answers.reserve(count);
  const char *at = text.data(), *const end = at + text.size();
  for (;;) {
    while (at < end && (*at == ' ' || *at == '\n' || *at == '\r' || *at == '\t')) ++at;
    if (at == end) break;
    double value = 0.0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || value != value) {
      throw Error("number " + std::to_string(answers.size() + 1) + " of " + file +
                  " is not a time: write one number for each sweep, 1 or more if nothing is hit");
    }
    answers.push_back(value);
    at = next;
  }
  if (answers.size() != count) {
    throw Error(file + " has " + std::to_string(answers.size()) + " times for " + std::to_string(count) +
                " sweeps; it needs one for each");
  }
  return answers;
}

std::string table(const std::string& who, const Scores& scores) {
  std::string out = fmt::format(
      "{}: missed or late by more than {:g} mm; early by more than {:g} mm\n\n{:<14} {:>9} {:>9} {:>8} {:>8} {:>8} "
      "{:>12} {:>12}\n",
      who, 1e3 * tolerated, 1e3 * far_off, "kind", "sweeps", "hits", "missed", "late", "early", "deepest, m",
      "farthest, m");
  for (int k = 0; k < kind_count; ++k) {
    const LabelScore& s = scores[std::size_t(k)];
    out += fmt::format("{:<14} {:>9} {:>9} {:>8} {:>8} {:>8} {:>12.2g} {:>12.2g}\n", kind_name(k), s.sweeps, s.hits,
                       s.missed, s.late, s.early, s.deepest, s.farthest);
  }
  return out;
}

Json to_json(const std::string& who, const Scores& scores) {
  Json kinds = Json::array();
  for (int k = 0; k < kind_count; ++k) {
    const LabelScore& s = scores[std::size_t(k)];
    kinds.push_back({{"kind", kind_name(k)},
                     {"sweeps", s.sweeps},
                     {"hits", s.hits},
                     {"missed", s.missed},
                     {"late", s.late},
                     {"early", s.early},
                     {"deepest", s.deepest},
                     {"farthest", s.farthest}});
  }
  return {{"answers", who}, {"tolerated", tolerated}, {"far_off", far_off}, {"kinds", kinds}};
}

void show(const Options& options, const std::string& who, const Scores& scores) {
  if (options.json) return app::print(to_json(who, scores));
  app::print(table(who, scores));
}

app::ExitStatus judge_answers(const Options& options) {
  const std::vector<LabelledSweep> sweeps = read_labelled(options.file);
  const std::vector<double> answers = read_answers(options.answers, sweeps.size());
  Scores scores;
  app::Progress progress("judging", "sweeps");
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    judge(sweeps[i], answers[i], scores[std::size_t(sweeps[i].kind)]);
    if (i % 1024 == 0) progress.at(i, sweeps.size());
  }
  show(options, options.answers, scores);
  return app::done;
}

/// roam's promise is stricter than the tolerance: no body is ever deeper than its start.
bool broke_its_promise(const LabelledSweep& s, const SweepResult& answer) {
  return answer.hit ? answer.time > s.time : s.hit == 1;
}

app::ExitStatus make(const Options& options) {
  app::check_output("FILE", options.file);
  if (std::error_code none; std::filesystem::exists(options.file, none) && !is_labelled(options.file)) {
    throw app::UsageError(options.file, "this is another file, which would be lost; name a new one");
  }
  files::WholeFile file(options.file);
  const std::string header = numpy_header(options.count);
  file.write(std::as_bytes(std::span(header)));
  Scores scores;
  std::uint64_t wrong = 0, done = 0;
  app::Progress progress("labelling", "sweeps");
  make_labelled(options.count, options.seed, [&](std::span<const LabelledSweep> made) {
    file.write(std::as_bytes(made));
    for (const LabelledSweep& s : made) {
      const SweepResult answer = sweep(s.body(), s.start(), s.way(), s.corners());
      wrong += broke_its_promise(s, answer) ? 1 : 0;
      judge(s, answer.hit ? answer.time : 1.0, scores[std::size_t(s.kind)]);
    }
    progress.at(done += made.size(), options.count);
  });
  file.commit();
  show(options, "roam::sweep", scores);
  return wrong > 0 ? app::answer_no : app::done;
}

constexpr const char* help =
    "FILE becomes a numpy array of records: `numpy.load(FILE)`. Each is a body (a sphere, or an upright capsule with "
    "a\n"
    "half height), its start and motion, one triangle, and the answer: `time` is the greatest double up to which the\n"
    "body is free, `point` what it then meets, `gap` its least distance from the triangle during the motion, less\n"
    "than 0 where it is hit. All were computed by brute force in 113-bit arithmetic. Kinds: ordinary, grazing, along\n"
    "an edge, at a corner, slivers, degenerate triangles, embedded and touching starts, motions of 1e-9 to 1e5 m.\n\n"
    "To judge another engine, let it answer the sweeps, and write one time a line.\n\n"
    "Examples:\n"
    "  roam bench labels sweeps.npy\n"
    "  roam bench labels sweeps.npy --judge times.txt\n";

}  // namespace

void add_labels(CLI::App& program, app::Run& run) {
  CLI::App* verb = program.add_subcommand("labels", "Sweeps with exact answers, to judge any engine");
  verb->footer(help);
  const auto options = std::make_shared<Options>();
  verb->add_option("FILE", options->file, "The labelled sweeps: written, or read with --judge")
      ->required()
      ->type_name("");
  verb->add_option("--judge", options->answers, "Judge these answers: a time for each sweep")->type_name("FILE");
  verb->add_option("--count", options->count, "How many sweeps to make (e.g. 500k or 20M)")
      ->transform(app::counted())
      ->check(app::from_to<std::uint64_t>(1, 50'000'000))
      ->excludes("--judge")
      ->type_name("N")
      ->capture_default_str();
  verb->add_option("--seed", options->seed, "Other sweeps for another number")
      ->check(app::seed())
      ->excludes("--judge")
      ->capture_default_str();
  verb->add_flag("--json", options->json, "Print one JSON object");
  verb->callback([options, &run] {
    run = [options] { return options->answers.empty() ? make(*options) : judge_answers(*options); };
  });
}

}  // namespace roam::bench
