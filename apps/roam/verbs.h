#pragma once
/// \file
/// The verbs of the command line, one file each.

#include "cli/command_line.h"

namespace roam::app {

/// Each adds its verb to the program; choosing the verb sets `run`.
void add_walk(CLI::App& program, Run& run);
void add_sweep(CLI::App& program, Run& run);
void add_info(CLI::App& program, Run& run);
void add_make(CLI::App& program, Run& run);
void add_build(CLI::App& program, Run& run);
void add_cluster(CLI::App& program, Run& run);
void add_publish(CLI::App& program, Run& run);
void add_bench(CLI::App& program, Run& run);
void add_train(CLI::App& program, Run& run);
void add_verify(CLI::App& program, Run& run);
void add_check(CLI::App& program, Run& run);
void add_probe(CLI::App& program, Run& run);
void add_view(CLI::App& program, Run& run);
/// Hidden: the build writes man pages with it.
void add_reference(CLI::App& program, Run& run);

}  // namespace roam::app
