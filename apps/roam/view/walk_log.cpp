#include "view/walk_log.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace roam::app {

WalkLog::WalkLog(const std::filesystem::path& trace, bool keep_pieces) : keep_pieces_(keep_pieces) {
  if (!trace.empty()) trace_.emplace(trace);
}

void WalkLog::take(const StepReport& report, Mode mode, double seconds) {
  if (trace_) trace_->add(rows_, simulated_, report);
  const bool certified = mode != Mode::ghost && !report.held;
  if (keep_pieces_ && certified) append_pieces(pieces_, rows_, report);
  ++rows_;
  if (certified) least_clearance_ = std::min(least_clearance_.value_or(report.least_clearance), report.least_clearance);
  if (seconds <= 0.0) return;
  ++steps_;
  simulated_ += report.elapsed;
  if (report.has(EventKind::throttled) || report.has(EventKind::slowed)) ++throttled_;
  Vec3 last = report.from;
  for (const Corner& corner : report.corners) {
    if (!corner.teleport) length_ += glm::distance(last, corner.position);
    last = corner.position;
  }
}

void WalkLog::take_frame(std::int64_t passed, std::int64_t own) {
  collision_.add(static_cast<double>(passed));
  own_collision_.add(static_cast<double>(own));
}

void WalkLog::finish() {
  if (trace_) trace_->close();
  trace_.reset();
}

}  // namespace roam::app
