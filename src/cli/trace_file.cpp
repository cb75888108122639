#include "cli/trace_file.h"

#include <fmt/format.h>

#include <iterator>
#include <span>
#include <string_view>

#include "cli/standard_streams.h"
#include "roam/error.h"

namespace roam::app {
namespace {

// Rows are written in blocks: a write for each row would cost more than the step that it describes.
constexpr std::size_t block_bytes = 1 << 16;
constexpr std::string_view first_columns = "step,t,x,y,z,";

std::string joined_events(const StepReport& report) {
  std::string text;
  for (const Event& event : report.events) {
    if (!text.empty()) text += '+';
    text += to_string(event.kind);
  }
  return text;
}

}  // namespace

FileKind traces() { return beginning_with(std::string(first_columns), "trace"); }

TraceFile::TraceFile(const std::filesystem::path& file) {
  if (!is_standard(file)) out_.emplace(file, files::Naming::exact, traces());
  rows_ = std::string(first_columns) + "radius,height,clearance,contacts,event,teleport\n";
}

void TraceFile::add(std::uint64_t step, double step_start, const StepReport& report) {
  const auto row = [&](double time, const Vec3& p, double radius, double height, double clearance, std::size_t contacts,
                       const std::string& events, bool teleport) {
    fmt::format_to(std::back_inserter(rows_), "{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{},{},{}\n",
                   step, time, p.x, p.y, p.z, radius, height, clearance, contacts, events, teleport ? 1 : 0);
  };
  const std::string events = joined_events(report);
  if (step == 0) {
    // The requested place may be inside a wall; the walk starts where the body was put.
    row(step_start, report.to, report.radius, report.height, report.axis_clearance, report.contacts.total(), events,
        true);
    return;
  }
  for (const Segment& corner : report.segments) {
    const bool last = &corner == &report.segments.back();
    row(step_start + corner.time, corner.position, corner.radius, corner.height, corner.axis_clearance,
        last ? report.contacts.total() : 0, last ? events : std::string(), corner.teleport);
  }
  if (report.segments.empty()) {
    row(step_start + report.elapsed, report.to, report.radius, report.height, report.axis_clearance,
        report.contacts.total(), events, false);
  }
  if (rows_.size() >= block_bytes) write_rows();
}

void TraceFile::write_rows() {
  try {
    if (!failure_ && out_) out_->write(std::as_bytes(std::span(rows_)));
    if (!failure_ && !out_) write_output(rows_);
  } catch (const Error&) {
    failure_ = std::current_exception();
  }
  rows_.clear();
}

void TraceFile::close() {
  write_rows();
  if (failure_) std::rethrow_exception(failure_);
  if (out_) out_->commit();
}

}  // namespace roam::app
