#pragma once
/// \file
/// The limit of steps.

namespace roam {

/// The highest step of a body of that height, both in m. A body climbs onto what is higher.
[[nodiscard]] constexpr double step_limit(double height) { return 0.5 * height; }

}  // namespace roam
