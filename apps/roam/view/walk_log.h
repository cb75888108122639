#pragma once
/// \file
/// What is kept of a session's steps: the trace, the pieces for --verify, times, the least clearance.

#include <cstdint>
#include <filesystem>
#include <optional>

#include "cli/histogram.h"
#include "cli/trace_file.h"
#include "roam/tally.h"
#include "roam/walker.h"
#include "verify/piece_log.h"
#include "view/view_report.h"

namespace roam::app {

/// Takes down every step of a body that a person leads. It takes the same memory for a minute and for a
/// day.
class WalkLog {
 public:
  /// An empty path: no trace. `keep_pieces`: for verify().
  WalkLog(const std::filesystem::path& trace, bool keep_pieces);

  /// After a step of `seconds`, or a placement (0). The first is the start. Steps of a ghost stand in the trace,
  /// but are nothing that could be verified.
  void take(const StepReport& report, Mode mode, double seconds);
  /// The time that all steps of a frame took, ns: by the clock, and what their thread itself used of it.
  void take_frame(std::int64_t passed, std::int64_t own);
  /// Writes what is left. Throws roam::Error when not all of the trace could be written.
  void finish();

  /// Sums over the steps and placements; a ghost has no clearance.
  [[nodiscard]] const Tally& tally() const { return tally_; }
  /// Adds the steps and the trace, and gives away the pieces for verify().
  void fill(ViewReport& report);

 private:
  std::filesystem::path trace_file_;
  std::optional<TraceFile> trace_;
  bool keep_pieces_;
  verification::PieceLog pieces_;
  Histogram collision_, own_collision_;  ///< ns a frame with steps: by the clock, and the thread's own
  std::uint64_t rows_ = 0;               ///< of the trace, counted in steps and placements
  Tally tally_;
};

}  // namespace roam::app
