#pragma once
/// \file
/// One row of the paper's tables, run by a process of its own.

#include "paper_scene.h"

namespace roam::bench {

struct RowResult {
  std::string failure;           ///< empty, or how it ended before it was done
  bool adapts = false;           ///< it can change the radius on the way
  double load_seconds = 0.0;     ///< from the start until a body can move at the start of the first way
  std::uint64_t peak_bytes = 0;  ///< resident: its own peak and that of the largest program that it started
  std::vector<Walked> ways;      ///< as paper_ways
};

/// Starts this program again with the row's name, and waits. A row that takes more memory than it may, or longer until
/// it can move, or does not come out of a step, is ended: then `failure` says so. Throws roam::Error when it cannot be
/// started, and roam::Cancelled after Ctrl-C: then the row has ended, too.
[[nodiscard]] RowResult run_row(const std::string& name, const PaperScene& scene, const PaperOptions& options);

/// What the child does: walks all ways and writes the result to the descriptor that run_row gave it. `argv` as run_row
/// passes it.
[[nodiscard]] int row_main(int argc, char** argv);
/// The first argument of such a child.
inline constexpr const char* row_verb = "--row-of-the-paper";

}  // namespace roam::bench
