// The command line `roam`: its verbs and common options.
#include <CLI/CLI.hpp>
#include <string>

#include "cli/command_line.h"
#include "cli/help.h"
#include "roam/error.h"
#include "roam/import.h"
#include "roam/version.h"
#include "verbs.h"

namespace {

constexpr const char* description = "roam: walk and fly through any 3D scene without ever passing through a wall.";

constexpr const char* help = R"(`roam help VERB` explains a verb, with examples.

Results go to standard output, progress and notes to standard error.
Exit status 0 for yes or done; 1 for a failure, whose message names the fault, its place and the remedy; 2 for wrong
usage; 3 for the answer no. After Ctrl-C a verb tidies up and ends within a second, or two minutes if its results take
long to write; a second Ctrl-C ends it at once: exit status 130 (SIGTERM: 143).

Examples:
  roam view mine.dae
  roam make gallery -o gallery.ply
  roam walk gallery.ply --path gallery-straight.path --mode fly --speed 50 --verify
  roam info mine.dae --json
)";

/// The version, and the sandbox that this machine offers to readers of scenes.
std::string version() {
  std::string text = "roam " ROAM_VERSION_STRING "\nscenes are read behind: ";
  try {
    const roam::Confinement walls = roam::reader_confinement();
    text += walls.landlock > 0 ? "Landlock " + std::to_string(walls.landlock) : std::string("no Landlock");
    text += walls.system_calls ? ", seccomp" : ", no seccomp";
    text += walls.no_new_privileges ? ", no_new_privs" : ", privileges as they are";
    text += walls.limits ? ", limits" : ", no limits";
    text += walls.empty_folder ? ", an empty folder" : ", the root folder";
  } catch (const roam::Error& error) {
    text += std::string("nothing; ") + error.what();
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  roam::app::end_plainly_without_memory();
  CLI::App program{description, "roam"};
  program.footer(help);
  program
      .set_version_flag("-v,--version", version,
                        "Show the version, and this system's protection from hostile scene files")
      ->group(roam::app::other_group);
  program.require_subcommand(1);
  roam::app::Run chosen;
  roam::app::add_view(program, chosen);
  roam::app::add_walk(program, chosen);
  roam::app::add_probe(program, chosen);
  roam::app::add_sweep(program, chosen);
  roam::app::add_info(program, chosen);
  roam::app::add_train(program, chosen);
  roam::app::add_make(program, chosen);
  roam::app::add_verify(program, chosen);
  roam::app::add_check(program, chosen);
  roam::app::add_build(program, chosen);
  roam::app::add_cluster(program, chosen);
  roam::app::add_publish(program, chosen);
  roam::app::add_bench(program, chosen);
  roam::app::add_reference(program, chosen);
  return roam::app::run_command_line(program, chosen, argc, argv);
}
