#include "cli/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>

#include "cli/help.h"
#include "cli/interrupt.h"
#include "cli/report.h"
#include "cli/tell.h"
#include "cli/usage.h"
#include "roam/error.h"

namespace roam::app {
namespace {

/// The arguments as CLI11 takes them, last first. `help VERB` is `VERB --help`.
std::vector<std::string> reversed_arguments(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (!arguments.empty() && arguments.front() == "help") {
    arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
  }
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

ExitStatus refuse(const CLI::App& app, const std::string& sentence) {
  const std::string name = full_name(app);
  tell(sentence, name);
  std::fputs(fmt::format("`{} --help` lists what it takes.\n", name).c_str(), stderr);
  return bad_usage;
}

ExitStatus run(CLI::App& program, const Run& chosen, int argc, char** argv) {
  set_up_help(program);
  try {
    program.parse(reversed_arguments(argc, argv));
  } catch (const CLI::CallForHelp&) {
    // Not of a verb that there is not.
    const auto unknown = unknown_word(program);
    if (unknown && !unknown->is_option) return refuse(*unknown->app, unknown->sentence);
    print(program.help());
    return done;
  } catch (const CLI::CallForVersion& version) {
    print(std::string(version.what()) + "\n");
    return done;
  } catch (const CLI::ParseError& error) {
    const auto unknown = unknown_word(program);
    if (unknown) return refuse(*unknown->app, unknown->sentence);
    return refuse(reached(program), sentence_of(reached(program), error));
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
