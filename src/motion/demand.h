#pragma once
/// \file
/// Checks of options.

#include <limits>

namespace roam {

struct Range {
  double lower, upper;
  bool open;  ///< the lower end itself is refused
};
/// Finite and more than 0.
inline constexpr Range positive{0.0, std::numeric_limits<double>::max(), true};

/// Throws roam::Error if the value is not in the range, or not a number: "the route's speed is -1 m/s; it must be ...".
/// `hint` ends the message.
void demand(const char* whose, const char* what, double value, const char* unit, const Range& range,
            const char* hint = "");

}  // namespace roam
