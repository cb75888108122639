// roam cluster: writes jobs for a batch engine that build a store on many machines.
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/exit_status.h"
#include "cli/standard_streams.h"
#include "cli/values.h"
#include "files/descriptor.h"
#include "process/find_program.h"
#include "roam/error.h"
#include "roam/store_build.h"
#include "scenes/beside_scene.h"
#include "scenes/scene_options.h"
#include "text/printable.h"
#include "verbs.h"

namespace roam::app {
namespace {

struct ClusterVerb {
  SceneOptions scene;
  std::filesystem::path output;
  std::uint64_t shards = 0;
  bool submit = false;
};

/// Whether a word has a control character. A byte that is not UTF-8 counts as the character of Latin-1.
bool has_control(std::string_view word) {
  while (!word.empty()) {
    const Character first = first_character(word);
    if (is_control(first.bytes > 0 ? first.code : static_cast<unsigned char>(word[0]))) return true;
    word.remove_prefix(std::max(first.bytes, std::size_t{1}));
  }
  return false;
}

/// A word of the shell. Throws UsageError for control characters, such as line breaks.
std::string quoted(const std::string& word) {
  if (has_control(word)) {
    throw UsageError(word, "this name has a line break or another control character; rename it");
  }
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string quoted(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += " " + quoted(word);
  return text;
}

/// A script of the shell that submits the jobs of a build.
std::string slurm_script(const ClusterVerb& verb) {
  const std::string roam = quoted(process::own_program().string()), out = quoted(verb.output.string());
  const std::string limits = fmt::format(" --threads={} --memory={}", verb.scene.threads, *verb.scene.memory);
  // Slurm also counts what roam does not: pages of files, the allocator's reserve.
  const std::uint64_t mebibytes = (*verb.scene.memory >> 20) * 5 / 4;
  const auto job = [&](const char* name, const std::string& options, const std::string& arguments) {
    return fmt::format(
        "{0}=$(sbatch --parsable --requeue --job-name=roam-{0} --cpus-per-task={1} --mem={2}M{3} << 'END'\n"
        "#!/bin/sh\n"
        "exec {4} build --output={5}{6}\n"
        "END\n"
        ")\n"
        "{0}=${{{0}%%;*}}\n"
        "jobs=\"$jobs ${0}\"\n",
        name, verb.scene.threads, mebibytes, options, roam, out, arguments);
  };
  const std::string array = fmt::format(" --array=0-{}", verb.shards - 1);
  const std::string plan = fmt::format(" --plan={}{}", verb.shards, quoted(verb.scene.arguments()));
  const std::string after = " --kill-on-invalid-dep=yes --dependency=afterok:$plan";
  return "#!/bin/sh\n"
         "# Submits four jobs to Slurm: an array that reads the scene, a plan, which reads what is missing then, an\n"
         "# array of tasks, and a merge, which says what is missing. After a failure, the same again goes on.\n"
         "# sbatch reads SBATCH_PARTITION, SBATCH_ACCOUNT, SBATCH_TIMELIMIT.\n"
         "set -eu\n"
         "jobs=\n"
         "trap 'test -z \"$jobs\" || scancel $jobs' EXIT  # if one cannot be submitted\n" +
         job("read", array, " --shard=auto" + plan) + job("plan", " --dependency=afterany:$read", plan) +
         job("tasks", after + array, limits + " --shard=auto") +
         job("merge", after + ",afterany:$tasks", limits + " --merge") +
         "trap - EXIT\n"
         "echo \"The jobs are$jobs; the last one writes slurm-$merge.out.\"\n";
}

ExitStatus slurm(ClusterVerb verb) {
  verb.scene.check_there();
  if (verb.output.empty()) {
    verb.output = store_beside(verb.scene.scenes.front());
    demand_no_link(verb.output);
  }
  if (verb.scene.threads == 0) verb.scene.threads = 2;
  verb.scene.memory = std::max(verb.scene.memory.value_or(StoreBuildOptions{}.memory), StoreBuildOptions::least_memory);
  const std::string script = slurm_script(verb);
  if (!verb.submit) {
    // Not print(), which shortens long lines: this is for a shell.
    write_output(script);
    return done;
  }
  if (process::find_program("sbatch").empty()) {
    throw Error::at("--submit",
                    "there is no sbatch here; start the script, which the command prints without --submit, "
                    "on a machine that has it");
  }
  // An argument may have 128 KiB, which the names of some thousand scenes exceed.
  const int file = ::memfd_create("script", 0);
  const auto bytes = std::as_bytes(std::span(script));
  if (file >= 0 && files::write_fully(file, bytes) == bytes.size()) {
    ::execl("/bin/sh", "sh", fmt::format("/dev/fd/{}", file).c_str(), nullptr);
  }
  throw Error::at("/bin/sh", std::string("cannot start /bin/sh: ") + std::strerror(errno));
}

constexpr const char* slurm_help =
    R"(Prints a script of the shell. It submits an array of N tasks that read the scene, a job that plans, an array of N
tasks that build the shards, and a job that merges them and says what is missing. All machines must see the scene, the
store and your home by the same paths. docs/cluster.md has scripts for other engines.

Examples:
  roam cluster slurm Data/ -o dam.roam --shards 64 > dam.sh
  roam cluster slurm Data/ -o dam.roam --shards 64 --submit
)";

}  // namespace

void add_cluster(CLI::App& program, Run& run) {
  CLI::App* verb = program.add_subcommand("cluster", "Build a store on many machines: jobs for Slurm");
  verb->require_subcommand(1);
  verb->footer("Examples:\n  roam cluster slurm Data/ -o dam.roam --shards 64 --submit\n");

  CLI::App* slurm_kind = verb->add_subcommand("slurm", "Write or submit the jobs of a build for Slurm");
  slurm_kind->footer(slurm_help);
  const auto options = std::make_shared<ClusterVerb>();
  options->scene.add_to(*slurm_kind);
  slurm_kind->get_option("--memory")->description("Memory of each job (default: 1G; at least 256M)");
  slurm_kind->get_option("--threads")->description("Cores of each job (default: 2)");
  slurm_kind->option_defaults()->group("Jobs");
  slurm_kind->add_option("-o,--output", options->output, "Folder of the store (default: SCENE.roam beside the scene)")
      ->type_name("FOLDER");
  slurm_kind->add_option("--shards", options->shards, "Tasks of each array, as N of `roam build --plan N`")
      ->required()
      ->check(from_to<std::uint64_t>(1, 1'000'000))
      ->type_name("N");
  slurm_kind->add_flag("--submit", options->submit, "Submit the jobs instead of printing the script");
  slurm_kind->callback([options, &run] { run = [options] { return slurm(*options); }; });
}

}  // namespace roam::app
