#include "cli/command_line.h"

#include <fmt/format.h>

#include <exception>
#include <new>
#include <sstream>

#include "cli/interrupt.h"
#include "cli/report.h"
#include "cli/tell.h"
#include "roam/error.h"

namespace roam::app {
namespace {

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
  return fmt::format("{}: {}\n`{} --help` lists what it takes.\n", verb, printable_part(what), verb);
}

int run(CLI::App& program, const Run& chosen, int argc, char** argv) {
  program.failure_message(usage_message);
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

}  // namespace

int run_command_line(CLI::App& program, Run& chosen, int argc, char** argv) {
  catch_signals();
  const std::string name = program.get_name();
  try {
    return run(program, chosen, argc, argv);
  } catch (const UsageError& error) {
    tell(error.what(), name);
    return bad_usage;
  } catch (const BrokenPipe&) {
    return failed;
  } catch (const Cancelled&) {
    tell("cancelled", name);
    return failed;
  } catch (const std::bad_alloc&) {
    tell("out of memory; take a smaller scene or a machine with more memory", name);
    return failed;
  } catch (const std::exception& error) {
    // Ctrl-C also reaches the reader's process; its end is then no error of the file.
    tell(interrupted() ? "cancelled" : error.what(), name);
    return failed;
  }
}

}  // namespace roam::app
