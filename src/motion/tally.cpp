#include <algorithm>
#include <glm/geometric.hpp>

#include "math/floating_point.h"
#include "roam/step_report.h"

namespace roam {
namespace {

/// Adds the length of a step to the sum, piece by piece.
double plus_length(double sum, const StepReport& report) {
  Vec3 at = report.from;
  for (const Segment& c : report.segments) {
    if (!c.teleport) sum += glm::length(c.position - at);
    at = c.position;
  }
  return sum;
}

}  // namespace

double StepReport::length() const {
  const DefaultFloatingPoint guard;
  return plus_length(0.0, *this);
}

void Tally::add_step(const StepReport& report) {
  const DefaultFloatingPoint guard;
  ++steps;
  length = plus_length(length, report);
  simulated += report.elapsed;
  if (report.has(EventKind::throttled) || report.has(EventKind::slowed)) ++throttled;
  add_placement(report);
}

void Tally::add_placement(const StepReport& report) {
  // A body that does not fit has no clearance and makes no move.
  if (!(report.least_axis_clearance > 0.0)) return;
  const bool first = !(least_axis_clearance > 0.0);
  least_axis_clearance =
      first ? report.least_axis_clearance : std::min(least_axis_clearance, report.least_axis_clearance);
  least_gap = first ? report.least_gap : std::min(least_gap, report.least_gap);
}

}  // namespace roam
