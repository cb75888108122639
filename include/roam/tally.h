#pragma once
/// \file
/// A tally of a run of steps: length, time, least clearance, events. Lengths are metres, times seconds.

#include <cstdint>
#include <vector>

#include "roam/step_report.h"

namespace roam {

struct RouteEvent {
  std::uint64_t step = 0;  ///< counted from 1; 0 is the start
  Event event;
};

struct Tally {
  std::uint64_t steps = 0;
  double length = 0.0;                ///< of the way that the centre moved, without teleports
  double simulated = 0.0;             ///< time
  double least_axis_clearance = 0.0;  ///< the least StepReport::least_axis_clearance; 0: none was certified yet
  double least_gap = 0.0;             ///< the least StepReport::least_gap, with the radius that the body had there
  std::uint64_t throttled = 0;        ///< steps that ended early or were slowed, see EventKind
  void add_step(const StepReport& report);
  void add_placement(const StepReport& report);  ///< of place(), as at the start: only its clearance counts
};

/// A filter for the events of a run that are worth a line.
class EventFilter {
 public:
  /// Appends the first event of each kind of the next step, unless the step before had that kind too.
  void append(std::vector<RouteEvent>& events, std::uint64_t step, const StepReport& report);

 private:
  std::uint32_t last_kinds_ = 0;  ///< bit set of the kinds of the last step's events
};

}  // namespace roam
