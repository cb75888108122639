#pragma once
/// \file
/// Steps so short that a walk would never end.

#include <cstdint>

#include "roam/route.h"

namespace roam {

/// Steps. Fewer may be short by chance, as in a narrow corner.
constexpr std::uint64_t most_vain_steps = 64;

/// Counts a step in a row of vain ones, in `row`. Returns whether the row is too long. A vain step was throttled to
/// less than Route::shortest_step; at the highest speed that is a centimetre.
[[nodiscard]] inline bool is_vain_again(const StepReport& step, std::uint64_t& row) {
  row = step.has(EventKind::throttled) && step.elapsed < Route::shortest_step ? row + 1 : 0;
  return row >= most_vain_steps;
}

}  // namespace roam
