#pragma once
/// \file
/// One row of the paper's tables, in a process of its own.

#include "paper_scene.h"

namespace roam::bench {

struct RowResult {
  std::string failure;           ///< empty, or how it ended early
  bool adapts = false;           ///< it can change the radius on the way
  double load_seconds = 0.0;     ///< from the start until a body can move on the first way
  std::uint64_t peak_bytes = 0;  ///< resident: its own peak and that of the largest program that it started
  std::vector<Walked> ways;      ///< as paper_ways
};

/// Runs this program again with the row's name, and waits. Ends a row that exceeds its memory or its time to load, or
/// hangs in a step; then `failure` says so. Throws roam::Error if it cannot be started, and roam::Cancelled after
/// Ctrl-C, when the row has ended too.
[[nodiscard]] RowResult run_row(const std::string& name, const PaperScene& scene, const PaperOptions& options);

/// The child's main function: walks all ways and writes the result to the descriptor from run_row. `argv` as run_row
/// passes it.
[[nodiscard]] int row_main(int argc, char** argv);
/// The first argument of such a child.
inline constexpr const char* row_verb = "--row-of-the-paper";

}  // namespace roam::bench
