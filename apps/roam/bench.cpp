// roam bench: starts the program roam-bench, which links the engines that roam is compared with.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "process/find_program.h"
#include "roam/error.h"
#include "verbs.h"

namespace roam::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* program_name = "roam-bench";

constexpr const char* bench_help = R"(Kinds:
  engines   sweeps through scenes: roam, Bullet, Embree, FCL, OpenSceneGraph, PhysX, Jolt, Box3D,
            three-mesh-bvh and the paper's method
  labels    a million sweeps with exact answers, to judge any engine
  paper     Tables 1 and 2 of Xie and Niu (2020), measured here
  scale     the time of a step from 100 thousand to 100 million triangles
  walkers   steps of roam, PhysX, Jolt and Bullet through one gallery

They are in a program of their own, roam-bench, which is built with -DROAM_BENCH=ON. `roam help bench engines` lists
the options of a kind.

Examples:
  roam bench engines
  roam bench paper --json
  roam bench scale --triangles 10M --picture scale.svg
)";

/// The roam-bench that belongs to this program. Throws roam::Error if there is none.
fs::path find_bench() {
  if (const char* named = std::getenv("ROAM_BENCH"); named != nullptr && *named != '\0') {
    if (process::can_run(named)) return named;
    throw Error::at(named, std::string("the environment variable ROAM_BENCH names ") + named +
                               ", which is not a program that can be run. Name the program " + program_name +
                               " of this installation.");
  }
  const fs::path folder = process::own_folder();
  const fs::path beside = folder / program_name;
  const fs::path installed = folder.parent_path() / "libexec" / "roam" / program_name;
  for (const fs::path& place : {beside, installed}) {
    if (process::can_run(place)) return place;
  }
  throw Error(std::string("the program ") + program_name + ", which compares roam with other engines, is not here " +
              "(looked at " + beside.string() + " and " + installed.string() +
              "). It is built from roam's sources: cmake --preset bench && cmake --build --preset bench; " +
              "or name it by the environment variable ROAM_BENCH.");
}

ExitStatus become(std::vector<std::string> arguments) {
  std::string program = find_bench().string();
  std::vector<char*> argv{program.data()};
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  ::execv(program.c_str(), argv.data());
  throw Error::at(program, "cannot start " + program + ": " + std::strerror(errno));
}

}  // namespace

void add_bench(CLI::App& program, Run& run) {
  CLI::App* verb =
      program.add_subcommand("bench", "Measure roam beside other engines: engines, labels, paper, scale or walkers");
  verb->footer(bench_help);
  verb->prefix_command();
  verb->callback([verb, &run] {
    const std::vector<std::string> arguments = verb->remaining();
    if (arguments.empty()) throw UsageError("bench", "a kind is missing: engines, labels, paper, scale or walkers");
    run = [arguments] { return become(arguments); };
  });
}

}  // namespace roam::app
