#pragma once
/// \file
/// The paper's two tables, from what the rows did.

#include "cli/exit_status.h"
#include "cli/report.h"
#include "paper_judge.h"
#include "row_process.h"

namespace roam::bench {

struct RowFindings {
  const PaperRow* row = nullptr;
  RowResult result;
  std::vector<Judgement> judged;  ///< as paper_ways; empty when the row failed or was not run
};

struct PaperFindings {
  std::string scene;
  std::uint64_t triangles = 0;
  double prepared = 0.0;  ///< seconds
  double patience = 0.0;  ///< seconds that a way could take
  std::vector<Way> ways;
  std::vector<RowFindings> rows;
};

/// A step that takes longer is a jam: the picture stands still. Seconds.
constexpr double jam = 0.016;
/// What a program for massive data may take, bytes.
constexpr std::uint64_t massive_limit = 1ull << 30;

[[nodiscard]] std::string paper_tables(const PaperFindings& findings);
[[nodiscard]] app::Json paper_json(const PaperFindings& findings);
/// Failed when a row of roam's own did not come to its end, answer_no when roam was in a wall. Rows of others may fail.
[[nodiscard]] app::ExitStatus paper_status(const PaperFindings& findings);
/// The steps' times on the first two ways as bars. Throws roam::Error.
void draw_paper(const std::string& file, const PaperFindings& findings);

}  // namespace roam::bench
