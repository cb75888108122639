#pragma once
/// \file
/// The verbs of roam-bench, one file each.

#include "cli/command_line.h"

namespace roam::bench {

/// Each adds its verb to the program and sets `run` when the verb is chosen.
void add_engines(CLI::App& program, app::Run& run);
void add_labels(CLI::App& program, app::Run& run);
void add_paper(CLI::App& program, app::Run& run);
void add_scale(CLI::App& program, app::Run& run);
void add_walkers(CLI::App& program, app::Run& run);

}  // namespace roam::bench
