// roam build: builds a collision store of a scene of any size.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

#include "build/array_index.h"
#include "build/steps.h"
#include "cli/exit_status.h"
#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/report.h"
#include "cli/tell.h"
#include "cli/values.h"
#include "roam/error.h"
#include "roam/store.h"
#include "roam/store_build.h"
#include "scenes/beside_scene.h"
#include "scenes/frame.h"
#include "scenes/scene_options.h"
#include "scenes/user_key.h"
#include "verbs.h"

namespace roam::app {
namespace {

struct BuildVerb {
  SceneOptions scene;
  std::filesystem::path output;
  bool plan = false, merge = false, adopt = false, json = false, json_lines = false;
  std::vector<double> near;  ///< x, y, z; empty: no preference
  bool beside = false;       ///< the output has its default path
  std::uint64_t tasks = 0;   ///< of the plan, or shares of the scene; 0: not given
  std::optional<std::uint64_t> shard;
  std::optional<ArrayIndex> array;  ///< with --shard auto
  std::string reading;              ///< the first given option of reading_options; may be empty
};

/// Options that a plan fixes for its shards and its merge.
constexpr const char* reading_options[] = {"--up", "--unit", "--ignore", "--allow", "--lossless"};

StoreBuildOptions build_options(const BuildVerb& verb, Steps& steps) {
  StoreBuildOptions options;
  options.scene = verb.scene.scenes;
  options.output = verb.output;
  options.import = verb.scene.import_options();
  options.memory = verb.scene.memory.value_or(options.memory);
  options.threads = verb.scene.threads;
  options.lossless = verb.scene.lossless;
  options.tasks = verb.tasks;
  options.adopt = verb.adopt;
  options.through_link = !verb.beside;
  if (!verb.near.empty()) options.nearest_first = Vec3(verb.near[0], verb.near[1], verb.near[2]);
  options.progress = [&steps](const StoreBuildProgress& p) { return steps.show(p); };
  return options;
}

/// The user's key, made if there is none. If that fails: a key of this run; a build in steps throws roam::Error.
StoreKey build_key(const BuildVerb& verb) {
  UserKey user = made_user_key();
  if (user.key) return *user.key;
  if (verb.plan || verb.shard || verb.merge) {
    throw Error::at(
        user.problem.where(),
        fmt::format("a build in steps needs your key, by which the steps know each other: {}", user.problem.what()));
  }
  tell(
      fmt::format("note: no key of yours can be used: {}; without it a build begins anew, and `roam view` uses its "
                  "store only where you name it",
                  user.problem.what()));
  return key_of_this_run();
}

Json json_report(const BuildVerb& verb, const StoreBuildReport& report, double seconds) {
  Json json = {{"store", verb.output.string()},
               {"frame", verb.scene.scenes.empty() ? Json(nullptr) : to_json(frame_of(verb.scene))},
               {"unchanged", report.unchanged},
               {"triangles", report.triangles},
               {"parts", report.parts},
               {"parts_read", report.parts_read},
               {"shards", report.shards},
               {"shards_built", report.shards_built},
               {"shards_to_build", report.shards_to_build},
               {"tasks", report.tasks},
               {"read_s", report.read_seconds},
               {"plan_s", report.plan_seconds},
               {"shard_s", report.shard_seconds},
               {"merge_s", report.merge_seconds},
               {"seconds", seconds},
               {"notes", report.notes}};
  return json;
}

void tell_notes(const BuildVerb& verb, const StoreBuildReport& report) {
  for (const std::string& note : notes_as_sentences(report, verb.output)) tell("note: " + note);
}

void print_json(const BuildVerb& verb, const Json& report) {
  if (verb.json_lines) {
    print_line(report);
  } else {
    print(report);
  }
}

/// The longest task of a plan, divided by the mean.
double balance(const StoreBuildReport& report) {
  return static_cast<double>(report.longest_task) * static_cast<double>(report.tasks) /
         static_cast<double>(report.triangles_to_build);
}

/// Prints the steps after a plan.
void tell_tasks(const BuildVerb& verb, const StoreBuildReport& report) {
  const std::string store = printable_part(verb.output.string());
  if (report.tasks == 0) {
    print(fmt::format("no shards to build: go on with --merge ({})\n", store));
    return;
  }
  if (report.tasks == 1) {
    print(fmt::format("1 task: --shard 0, on any machine that sees {}; then --merge\n", store));
  } else {
    print(fmt::format("{} tasks: --shard 0 to --shard {}, on any machines that see {}; then --merge\n", report.tasks,
                      report.tasks - 1, store));
  }
  print(fmt::format("Parts read: {} of {}. Shards to build: {}. The longest task is {:.2f} times the mean.\n",
                    report.parts_read, report.parts, report.shards_to_build, balance(report)));
  if (report.tasks < verb.tasks) tell(fmt::format("note: there are not enough shards for {} tasks", verb.tasks));
}

/// Prints the summary of a complete store.
void tell_store(const BuildVerb& verb, const StoreBuildReport& report, double seconds) {
  const StoreInfo& info = report.store;
  const double per_triangle = static_cast<double>(info.bytes) / static_cast<double>(info.triangles);
  if (verb.json) {
    Json json = json_report(verb, report, seconds);
    json["tiles"] = info.tiles;
    json["bytes"] = info.bytes;
    json["bytes_per_triangle"] = per_triangle;
    json["hash"] = info.hash;
    print_json(verb, json);
  } else if (report.unchanged) {
    print(fmt::format("{} is up to date: {} triangles, nothing has changed\n", printable_part(verb.output.string()),
                      info.triangles));
  } else {
    print(fmt::format(
        "{}: {} triangles in {} tiles, {}B, {:.2f} bytes a triangle\n"
        "read {} of {} parts, built {} of {} shards, in {}\n",
        printable_part(verb.output.string()), info.triangles, info.tiles, short_count(static_cast<double>(info.bytes)),
        per_triangle, report.parts_read, report.parts, report.shards_built, report.shards, short_time(seconds)));
  }
}

/// The report of --shard, with or without --plan.
void tell_task(const BuildVerb& verb, const StoreBuildReport& report, double seconds) {
  if (verb.json) {
    Json json = json_report(verb, report, seconds);
    json[verb.plan ? "share" : "task"] = *verb.shard;
    if (verb.plan) {
      json["share_parts"] = report.share_parts;
    } else {
      json["task_shards"] = report.task_shards;
    }
    if (verb.array) json["array"] = {{"engine", verb.array->engine}, {"variable", verb.array->variable}};
    print_json(verb, json);
    return;
  }
  const std::string job = verb.array ? fmt::format(" ({}, {})", verb.array->engine, verb.array->variable) : "";
  if (verb.plan) {
    print(fmt::format("share {} of {}{}: parts read: {}, known already: {}, in {}\n", *verb.shard, verb.tasks, job,
                      report.parts_read, report.share_parts - report.parts_read, short_time(seconds)));
  } else {
    print(fmt::format("task {} of {}{}: shards built: {}, there already: {}, in {}\n", *verb.shard, report.tasks, job,
                      report.shards_built, report.task_shards - report.shards_built, short_time(seconds)));
  }
}

/// For a job that finds its work done: an array may have more jobs than the plan has tasks, and an engine may repeat a
/// job after the merge.
ExitStatus nothing_to_do(const BuildVerb& verb, const std::string& why) {
  if (verb.json) {
    print_json(verb, {{"store", verb.output.string()}, {"nothing_to_do", why}});
  } else {
    print(fmt::format("nothing to do: {}\n", printable_part(why)));
  }
  return done;
}

ExitStatus run_steps(const BuildVerb& verb) {
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  StoreBuildReport report;
  {
    Steps steps(verb.output.string(), verb.json_lines);
    StoreBuildOptions options = build_options(verb, steps);
    options.key = build_key(verb);
    if (verb.plan && verb.shard) {
      read_share(options, *verb.shard, report);
      tell_notes(verb, report);
      tell_task(verb, report, seconds());
      return done;
    }
    if (verb.plan) {
      plan_store(options, report);
      if (!report.unchanged) {
        tell_notes(verb, report);
        if (verb.json) {
          Json json = json_report(verb, report, seconds());
          if (report.tasks > 0) json["balance"] = balance(report);
          print_json(verb, json);
        } else {
          tell_tasks(verb, report);
        }
        return done;
      }
    } else if (verb.shard) {
      build_task(options, *verb.shard, report);
      tell_task(verb, report, seconds());
      return done;
    } else if (verb.merge) {
      merge_store(options, report);
    } else {
      report = build_store(options);
    }
  }
  tell_notes(verb, report);
  tell_store(verb, report, seconds());
  return done;
}

/// Rejects contradictory options before anything is written.
void check_usage(const BuildVerb& verb) {
  if (verb.scene.scenes.empty() && (verb.plan || (!verb.shard && !verb.merge))) {
    throw UsageError("build", "SCENE is required");
  }
  if (verb.plan && verb.shard && verb.tasks == 0) {
    throw UsageError("--plan with --shard", "the number of shares is missing: --plan N");
  }
  demand_memory_of_build(verb.scene.memory);
  if (!verb.near.empty() && (verb.plan || verb.merge)) {
    throw UsageError(fmt::format("--near with {}", verb.plan ? "--plan" : "--merge"),
                     verb.shard ? "a share only reads" : "only --shard builds shards; name the position there");
  }
  if (!verb.plan && (verb.shard || verb.merge)) {
    if (verb.reading.empty()) return;  // --shard and --merge read the plan, not the scene
    throw UsageError(fmt::format("{} with {}", verb.reading, verb.shard ? "--shard" : "--merge"),
                     "how the scene is read was fixed by --plan; leave it out, or plan again with it");
  }
  verb.scene.check_files_there("name the scene that it was made of");
}

ExitStatus build(BuildVerb verb) {
  demand_no_address("-o", verb.output);
  check_usage(verb);
  take_kept_frame(verb.scene);
  if (verb.output.empty()) {
    if (verb.scene.scenes.empty()) throw UsageError("build", "without SCENE, -o says which store is meant");
    verb.output = store_beside(verb.scene.scenes.front());
    verb.beside = true;
    demand_no_link(verb.output);
  }
  try {
    return run_steps(verb);
  } catch (const NoSuchTask& none) {
    // A plan may have fewer tasks than were wished for.
    return nothing_to_do(verb, verb.array ? fmt::format("{} ({})", none.what(), verb.array->variable) : none.what());
  } catch (const NothingPlanned&) {
    if (!Store::is_store(verb.output)) throw;
    return nothing_to_do(verb, fmt::format("{} is complete, and no build of it is planned", verb.output.string()));
  } catch (const std::exception&) {
    // Ctrl-C also ends the reader process, which is then no error of the scene.
    if (!interrupted()) throw;
    throw Stopped(user_key().key
                      ? fmt::format("stopped; what was done is kept in {}: the same command again goes on from there",
                                    verb.output.string())
                      : "stopped; the same command begins anew, because no key of yours can be used");
  }
}

/// The values of --plan and --shard, as given.
struct Given {
  std::string plan, shard;
};

constexpr std::uint64_t most_tasks = 1'000'000;

CLI::Validator task_number() {
  const CLI::Validator number = from_to<std::uint64_t>(0, most_tasks);
  return {[number](std::string& text) { return text == "auto" ? std::string() : number(text); }, ""};
}

void take(const Given& given, BuildVerb& verb) {
  const bool is_number = given.plan.find_first_not_of("0123456789") == std::string::npos;
  if (!given.plan.empty() && !is_number) {
    verb.scene.scenes.insert(verb.scene.scenes.begin(), given.plan);  // --plan without N, before SCENE
  } else if (!given.plan.empty()) {
    std::string text = given.plan;
    if (const std::string wrong = from_to<std::uint64_t>(1, most_tasks)(text); !wrong.empty()) {
      throw UsageError("--plan", wrong);
    }
    verb.tasks = std::stoull(given.plan);
  }
  if (given.shard == "auto") {
    verb.array = array_index();
    verb.shard = verb.array->task;
  } else if (!given.shard.empty()) {
    verb.shard = std::stoull(given.shard);
  }
}

constexpr const char* build_help =
    R"(A store is a folder that `roam walk`, `view`, `sweep` and `info` take like a scene. You walk in it at
full detail, in little memory. A build may be stopped or killed at any moment: the same command continues it, and the
manifest, packs and parts are the same to the last byte. After a change of the scene only the changed parts are built
again.

An existing store is updated if you built it; a key in $XDG_DATA_HOME/roam or ~/.local/share/roam proves that. Any
other store may lack a wall, and is refused unless --adopt says that you trust it.

Many machines that share a folder can build one store: first --plan, which divides the work into N tasks, then each task
by --shard, in any order, then --merge. Before that, --plan N with --shard I reads one of N shares of the scene, so that
the plan has little left to read. In an array of jobs of Slurm, Grid Engine, PBS, LSF, AWS Batch, Kubernetes or
GNU parallel, `--shard auto` takes the number of the job. `roam cluster` writes such jobs.

Examples:
  roam build mine.dae
  roam build Data/ -o dam.roam --memory 2G
  roam build Data/ -o dam.roam --plan 64 --shard 17
  roam build Data/ -o dam.roam --plan 64
  roam build -o dam.roam --shard 17
  roam build -o dam.roam --merge
)";

}  // namespace

void add_build(CLI::App& program, Run& run) {
  CLI::App* verb = program.add_subcommand("build", "Make a collision store of a scene of any size");
  verb->footer(build_help);
  const auto options = std::make_shared<BuildVerb>();
  options->scene.add_to(*verb);
  verb->get_option("SCENE")->required(false)->description(
      "Files, or folders of photogrammetry tiles; several files make one scene");
  verb->get_option("--memory")->description("Memory for the build and its reader (default: 1G; at least 256M)");
  verb->option_defaults()->group("Store");
  verb->add_option("-o,--output", options->output, "Folder of the store (default: SCENE.roam beside the scene)")
      ->type_name("FOLDER");
  verb->add_flag("--adopt", options->adopt, "Trust and update a store that somebody else built; it is yours then");
  add_place(*verb, "--near", options->near, "Build the parts near this position first; the store is the same")
      ->check(from_to(-coordinate_limit, coordinate_limit));
  verb->add_flag("--json", options->json, "Print one JSON object");
  verb->add_flag("--json-lines", options->json_lines,
                 "Print the progress as JSON objects, one a line, and at the end the object of --json");
  verb->option_defaults()->group("Many machines");
  const auto given = std::make_shared<Given>();
  CLI::Option* plan =
      verb->add_option(
              "--plan", given->plan,
              "Only read changed parts, and plan N tasks (default: the most tasks of about equal length, at most 1000)")
          ->expected(0, 1)
          ->type_name("N");
  CLI::Option* shard =
      verb->add_option("--shard", given->shard,
                       "Only build the shards of this task of the plan, counted from 0; with --plan: only read this "
                       "share of the scene; `auto`: the number of this job in an array of a batch engine")
          ->check(task_number())
          ->type_name("I");
  CLI::Option* merge = verb->add_flag("--merge", options->merge, "Only check all shards and publish the store");
  plan->excludes(merge);
  shard->excludes(merge);
  verb->callback([options, given, verb, &run] {
    options->plan = verb->get_option("--plan")->count() > 0;
    take(*given, *options);
    for (const char* name : reading_options) {
      if (options->reading.empty() && verb->get_option(name)->count() > 0) options->reading = name;
    }
    options->json |= options->json_lines;
    run = [options] { return build(*options); };
  });
}

}  // namespace roam::app
