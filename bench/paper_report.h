#pragma once
/// \file
/// The paper's two tables, from the results of the rows.

#include "cli/exit_status.h"
#include "cli/report.h"
#include "draw/sheet.h"
#include "paper_judge.h"
#include "row_process.h"

namespace roam::bench {

struct RowFindings {
  const PaperRow* row = nullptr;
  RowResult result;
  std::vector<Judgement> judged;  ///< in the order of paper_ways; empty if the row failed or did not run
};

struct PaperFindings {
  std::string scene;
  std::uint64_t triangles = 0;
  double prepared = 0.0;  ///< seconds
  double patience = 0.0;  ///< seconds, limit of a way
  std::vector<Way> ways;
  std::vector<RowFindings> rows;
};

/// Seconds. A longer step is a jam: the picture stands still.
constexpr double jam = 0.016;
/// Bytes, the limit for a program for massive data.
constexpr std::uint64_t massive_limit = 1ull << 30;

[[nodiscard]] std::string paper_tables(const PaperFindings& findings);
[[nodiscard]] app::Json paper_json(const PaperFindings& findings);
/// Failed if a row of roam's own did not finish, answer_no if roam was in a wall. Other rows may fail.
[[nodiscard]] app::ExitStatus paper_status(const PaperFindings& findings);
/// The steps' times on the first two ways as bars.
[[nodiscard]] draw::Sheet paper_chart(const PaperFindings& findings);

}  // namespace roam::bench
