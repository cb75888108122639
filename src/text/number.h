#pragma once
/// \file
/// Text of numbers that does not depend on the host's locale.

#include <array>
#include <charconv>
#include <string>

namespace roam {

/// The shortest decimal text that reads back as the same double: "0.3", "-1", "1e+30", "nan".
[[nodiscard]] inline std::string number_text(double value) {
  std::array<char, 32> digits;
  const auto written = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), written.ptr};
}

}  // namespace roam
