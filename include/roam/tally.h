#pragma once
/// \file
/// Sums over a run of steps: length, time, least clearance, events.

#include <cstdint>
#include <vector>

#include "roam/step_report.h"

namespace roam {

/// An event of a step of a run.
struct RouteEvent {
  std::uint64_t step = 0;  ///< the first step is 1; 0 is the start
  Event event;
};

/// Sums of a run. Takes no memory for its steps.
struct Tally {
  std::uint64_t steps = 0;
  double length = 0.0;     ///< metres that the centre moved, placing not counted
  double simulated = 0.0;  ///< seconds
  /// Metres, certified, over all moves; capped as StepReport::axis_clearance is. Of the axis: a body that becomes smaller on
  /// the way may come nearer with it. 0: none was certified yet.
  double least_axis_clearance = 0.0;
  /// The same of the body's surface, in the size that it had there: the least clearance - radius.
  double least_gap = 0.0;
  std::uint64_t throttled = 0;  ///< steps that ended early or were slowed, see EventKind

  /// After a step.
  void add_step(const StepReport& report);
  /// After a placement, the start for one: only its clearance counts.
  void add_placement(const StepReport& report);
};

/// Picks the events of a run that are worth a line: the first of each kind in a step, and the first of steps in a row
/// that report the kind.
class EventFilter {
 public:
  /// Appends those of a step. Steps come in their order.
  void append(std::vector<RouteEvent>& events, std::uint64_t step, const StepReport& report);

 private:
  std::uint32_t last_kinds_ = 0;  ///< bit set of the kinds of the last step's events
};

}  // namespace roam
