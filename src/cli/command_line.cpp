#include "cli/command_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <string_view>

#include "cli/failure.h"
#include "cli/help.h"
#include "cli/interrupt.h"
#include "cli/report.h"
#include "cli/standard_streams.h"
#include "cli/tell.h"
#include "cli/usage.h"
#include "files/unfinished.h"
#include "roam/error.h"

namespace roam::app {
namespace {

using Arguments = std::vector<std::string>;

/// The arguments in CLI11's order, last first. `help VERB` is `VERB --help`.
Arguments reversed(Arguments arguments) {
  if (!arguments.empty() && arguments.front() == "help") {
    arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
  }
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

/// Reports why the program `name` fails, also as JSON if requested.
void tell_failure(const Error& error, const std::string& name, const Arguments& arguments) {
  tell(error.what(), name);
  try {
    print_failure(error, arguments);
  } catch (const std::exception&) {
    // Standard output may be the cause.
  }
}

ExitStatus refuse(const CLI::App& app, const Error& error, const Arguments& arguments) {
  const std::string name = full_name(app);
  tell_failure(error, name, arguments);
  std::fputs(fmt::format("`{} --help` lists what it takes.\n", name).c_str(), stderr);
  return bad_usage;
}

/// Refuses an empty name of a file or folder, as from a variable of a shell that is not set: nothing would be written.
void demand_names(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    const std::string kind = option->get_type_name();
    if (kind != "FILE" && kind != "FOLDER" && kind != "DIR") continue;
    const char* const what = kind == "FILE" ? "a file" : "a folder";
    option->check({[what](std::string& name) { return name.empty() ? std::string(what) + " needs a name" : ""; }, ""});
  }
  for (CLI::App* below : app.get_subcommands({})) demand_names(*below);
}

ExitStatus run(CLI::App& program, const Run& chosen, const Arguments& arguments) {
  set_up_help(program);
  demand_names(program);
  try {
    program.parse(reversed(arguments));
  } catch (const CLI::CallForHelp&) {
    // An unknown verb has no help of its own.
    const auto unknown = unknown_word(program);
    if (unknown && !unknown->is_option) return refuse(*unknown->app, unknown->error, arguments);
    print(program.help());
    return done;
  } catch (const CLI::CallForVersion& version) {
    print(std::string(version.what()) + "\n");
    return done;
  } catch (const CLI::ParseError& error) {
    const auto unknown = unknown_word(program);
    if (unknown) return refuse(*unknown->app, unknown->error, arguments);
    return refuse(reached(program), usage_error(reached(program), error), arguments);
  }
  return chosen();
}

constexpr std::string_view out_of_memory = "out of memory; take a smaller scene or a machine with more memory";

const std::terminate_handler abort_with_message = std::get_terminate();

/// For std::set_terminate. Allocates nothing, so there is no JSON. Removes unfinished files.
void end_after_exception() {
  try {
    if (std::current_exception()) throw;
  } catch (const std::bad_alloc&) {
    for (const std::string_view part : {std::string_view("roam: "), out_of_memory, std::string_view("\n")}) {
      if (::write(STDERR_FILENO, part.data(), part.size()) < 0) break;
    }
    try {
      files::Unfinished::remove_all();
    } catch (const std::exception&) {
      // There is none.
    }
    std::_Exit(failed);
  } catch (...) {
  }
  abort_with_message();
}

/// The running exception as an error for the user.
Error running_error() {
  try {
    throw;
  } catch (const Stopped& stopped) {
    return Error(stopped.what());
  } catch (const std::bad_alloc&) {
    return Error(std::string(out_of_memory));
  } catch (const std::exception& other) {
    // Ctrl-C also reaches the reader's process; its end is then no error of the file.
    if (interrupted()) return Error("cancelled");
    const auto* error = dynamic_cast<const Error*>(&other);
    return error != nullptr ? *error : Error(other.what());
  }
}

int run_and_tell(CLI::App& program, const Run& chosen, const Arguments& arguments) {
  const std::string name = program.get_name();
  try {
    return run(program, chosen, arguments);
  } catch (const UsageError& error) {
    tell_failure(error, name, arguments);
    return bad_usage;
  } catch (const BrokenPipe&) {
    return failed;
  } catch (const std::exception&) {
    tell_failure(running_error(), name, arguments);
    return failed;
  }
}

}  // namespace

void end_plainly_without_memory() { std::set_terminate(end_after_exception); }

int run_command_line(CLI::App& program, Run& chosen, int argc, char** argv) {
  occupy_standard_streams();
  catch_signals();
  const int status = run_and_tell(program, chosen, Arguments(argv + 1, argv + argc));
  return status == failed && interrupted() ? interrupted_status() : status;
}

}  // namespace roam::app
