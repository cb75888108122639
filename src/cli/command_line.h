#pragma once
/// \file
/// The course of a program from its arguments to its exit status.

#include <functional>

#include "cli/exit_status.h"

namespace CLI {
class App;
}

namespace roam::app {

/// Runs the chosen verb after its options are read.
using Run = std::function<ExitStatus()>;

/// Call it first. When memory runs out where nothing can catch it, as while JSON is freed, the program then says so on
/// standard error and ends with ExitStatus::failed, instead of being aborted.
void end_plainly_without_memory();

/// Reads the arguments and runs `chosen`, which the callbacks of the program's verbs set. On an error writes a message
/// to standard error that begins with the program's name. Catches signals from now on.
[[nodiscard]] int run_command_line(CLI::App& program, Run& chosen, int argc, char** argv);

}  // namespace roam::app
