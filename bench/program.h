#pragma once
/// \file
/// The end of each benchmark program's main().

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

namespace roam::bench {

/// Parses the arguments, then returns the exit status that `run()` returns. 2, with the message on standard error, if
/// it throws.
template <class Run>
int run_program(CLI::App& app, int argc, char** argv, const Run& run) {
  CLI11_PARSE(app, argc, argv);
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}

}  // namespace roam::bench
