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

/// With that many decimals: "0.30". Never "-0.00".
[[nodiscard]] inline std::string fixed_text(double value, int decimals) {
  std::array<char, 400> digits;
  const auto written =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, decimals);
  std::string text(digits.data(), written.ptr);
  if (text.find_first_not_of("-0.") == std::string::npos && text.starts_with('-')) text.erase(0, 1);
  return text;
}

}  // namespace roam
