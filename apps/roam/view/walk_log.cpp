#include "view/walk_log.h"

#include <utility>

#include "cli/standard_streams.h"

namespace roam::app {

WalkLog::WalkLog(const std::filesystem::path& trace, bool keep_pieces) : trace_file_(trace), keep_pieces_(keep_pieces) {
  if (!trace.empty()) trace_.emplace(trace);
}

void WalkLog::take(const StepReport& report, Mode mode, double seconds) {
  if (trace_) trace_->add(rows_, tally_.simulated, report);
  if (keep_pieces_ && mode != Mode::ghost) verification::append_pieces(pieces_, rows_, report);
  ++rows_;
  if (seconds > 0.0) {
    tally_.add_step(report);
  } else {
    tally_.add_placement(report);
  }
}

void WalkLog::take_frame(std::int64_t passed, std::int64_t own) {
  collision_.add(static_cast<double>(passed));
  own_collision_.add(static_cast<double>(own));
}

void WalkLog::fill(ViewReport& report) {
  report.steps = tally_.steps;
  report.simulated = tally_.simulated;
  report.length = tally_.length;
  report.throttled = tally_.throttled;
  if (tally_.least_axis_clearance > 0.0) report.least_axis_clearance = tally_.least_axis_clearance;
  report.collision_ns = times(collision_, 1.0);
  report.collision_own_ns = times(own_collision_, 1.0);
  report.pieces = std::move(pieces_);
  const bool traced = !trace_file_.empty() && !trace_;
  if (traced && !is_standard(trace_file_)) report.written.push_back(trace_file_.string());
}

void WalkLog::finish() {
  if (trace_) trace_->close();
  trace_.reset();
}

}  // namespace roam::app
