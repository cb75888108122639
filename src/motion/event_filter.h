#pragma once
/// \file
/// The events of a run that are worth a line: see RouteResult::events.

#include <cstdint>
#include <vector>

#include "roam/route.h"

namespace roam {

class EventFilter {
 public:
  /// Appends the first event of each kind of the next step, unless the step before had that kind too.
  void append(std::vector<RouteEvent>& events, std::uint64_t step, const StepReport& report) {
    std::uint32_t kinds = 0;
    for (const Event& e : report.events) {
      const std::uint32_t bit = 1U << static_cast<unsigned>(e.kind);
      if (((kinds | last_kinds_) & bit) == 0) events.push_back({step, e});
      kinds |= bit;
    }
    last_kinds_ = kinds;
  }

 private:
  std::uint32_t last_kinds_ = 0;  ///< bit set of the kinds of the last step's events
};

}  // namespace roam
