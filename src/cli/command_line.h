#pragma once
/// \file
/// From the arguments of a program to its exit status.

#include <CLI/CLI.hpp>
#include <functional>

#include "cli/exit_status.h"

namespace roam::app {

/// What runs when a verb was chosen and its options are read.
using Run = std::function<ExitStatus()>;

/// Reads the arguments, runs what was `chosen` by them, and turns what went wrong into a message on standard error that
/// begins with the program's name. `chosen` is set by the callbacks of the program's verbs. Catches signals from now
/// on.
[[nodiscard]] int run_command_line(CLI::App& program, Run& chosen, int argc, char** argv);

}  // namespace roam::app
