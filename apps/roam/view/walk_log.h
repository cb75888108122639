#pragma once
/// \file
/// Log of a session's steps: the trace, the pieces for --verify, times, the least clearance.

#include <cstdint>
#include <filesystem>
#include <optional>

#include "cli/histogram.h"
#include "cli/trace_file.h"
#include "roam/step_report.h"
#include "roam/walker.h"
#include "verify/piece_log.h"
#include "view/view_report.h"

namespace roam::app {

/// Records every step of a body that a person leads. Its memory does not grow with time.
class WalkLog {
 public:
  /// `trace`: empty: no trace. `keep_pieces`: for verify().
  WalkLog(const std::filesystem::path& trace, bool keep_pieces);

  /// Call it after a step of `seconds`, or a placement (0). The first is the start. A ghost's steps are in the trace,
  /// but cannot be verified.
  void take(const StepReport& report, Mode mode, double seconds);
  /// Adds the time of all steps of a frame, ns: `passed` by the clock, `own` the thread's processor time.
  void take_frame(std::int64_t passed, std::int64_t own);
  /// Writes the rest. Throws roam::Error if the trace is incomplete.
  void finish();

  /// Sums over the steps and placements; a ghost has no clearance.
  [[nodiscard]] const Tally& tally() const { return tally_; }
  /// Call it after finish(). Adds the steps and the trace, and moves out the pieces for verify().
  void fill(ViewReport& report);

 private:
  std::filesystem::path trace_file_;
  std::optional<TraceFile> trace_;
  bool keep_pieces_;
  verification::PieceLog pieces_;
  Histogram collision_, own_collision_;  ///< ns per frame with steps: by the clock, and the thread's processor time
  std::uint64_t rows_ = 0;               ///< rows of the trace: steps and placements
  Tally tally_;
};

}  // namespace roam::app
