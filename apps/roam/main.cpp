// The command line `roam`: chooses the verb, runs it, and turns what went wrong into a message and an exit status.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>
#include <sstream>

#include "interrupt.h"
#include "report.h"
#include "roam/error.h"
#include "verbs.h"

namespace {

using namespace roam::app;

constexpr const char* description = "roam: walk and fly through any 3D scene without ever passing through a wall.";

constexpr const char* help =
    "\n`roam VERB --help` explains a verb, with examples.\n\n"
    "Results go to standard output, progress and notes to standard error.\n"
    "Exit status: 0 done; 1 failed, the message says what, where and what to do; 2 wrong usage; 3 the answer is no.\n\n"
    "Examples:\n"
    "  roam view mine.dae\n"
    "  roam make gallery -o gallery.ply\n"
    "  roam walk gallery.ply --path gallery-straight.path --mode fly --speed 50 --verify\n"
    "  roam info mine.dae --json\n";

/// What CLI11 found wrong, and where to look it up.
std::string usage_message(const CLI::App* app, const CLI::Error& error) {
  while (!app->get_subcommands().empty()) app = app->get_subcommands().front();
  std::string verb = app->get_name();
  for (const CLI::App* above = app->get_parent(); above != nullptr; above = above->get_parent()) {
    verb = above->get_name() + " " + verb;
  }
  std::string what = error.what();
  if (const auto* extras = dynamic_cast<const CLI::ExtrasError*>(&error)) {
    what = std::string("unknown option or argument:") +
           std::string(extras->what()).substr(std::string(what).find(':') + 1);
  }
  return fmt::format("{}: {}\n`{} --help` lists what it takes.\n", verb, what, verb);
}

int run(int argc, char** argv) {
  CLI::App program{description, "roam"};
  program.footer(help);
  program.set_version_flag("--version", "roam " ROAM_VERSION);
  program.require_subcommand(1);
  program.failure_message(usage_message);
  Run chosen;
  add_view(program, chosen);
  add_walk(program, chosen);
  add_probe(program, chosen);
  add_sweep(program, chosen);
  add_info(program, chosen);
  add_train(program, chosen);
  add_make(program, chosen);
  add_verify(program, chosen);
  add_build(program, chosen);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Help and version are results like others: written whole, or it is said that they are not.
    std::ostringstream told;
    const bool wanted = program.exit(error, told) == 0;
    if (wanted) print(told.str());
    return wanted ? done : bad_usage;
  }
  return chosen();
}

/// A message that cannot be written either, to a log on the disk that is full, is lost: the exit status still tells.
void tell(const char* message) {
  std::fputs("roam: ", stderr);
  std::fputs(message, stderr);
  std::fputs("\n", stderr);
}

}  // namespace

int main(int argc, char** argv) {
  catch_signals();
  try {
    return run(argc, argv);
  } catch (const UsageError& error) {
    tell(error.what());
    return bad_usage;
  } catch (const BrokenPipe&) {
    return failed;
  } catch (const roam::Cancelled&) {
    tell("cancelled");
    return failed;
  } catch (const std::bad_alloc&) {
    tell("out of memory; take a smaller scene or a machine with more memory");
    return failed;
  } catch (const std::exception& error) {
    // Ctrl-C also reaches the reader's process; its end is then no error of the file.
    tell(interrupted() ? "cancelled" : error.what());
    return failed;
  }
}
