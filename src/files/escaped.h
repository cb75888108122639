#pragma once
/// \file
/// Names with escaped bytes: % and two hexadecimal digits, as in addresses.

#include <algorithm>
#include <cctype>
#include <concepts>
#include <string>
#include <string_view>

#include "text/printable.h"

namespace roam::files {

/// A name with each % and two hexadecimal digits replaced by a byte: "a%20room.bin" -> "a room.bin".
[[nodiscard]] inline std::string unescaped(const std::string& name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto digit = [&](std::size_t k) { return std::isxdigit(static_cast<unsigned char>(name[k])) != 0; };
    if (name[i] == '%' && i + 2 < name.size() && digit(i + 1) && digit(i + 2)) {
      text += static_cast<char>(std::stoi(name.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      text += name[i];
    }
  }
  return text;
}

/// A name as valid UTF-8: bytes that are none, and characters that `keep` rejects, become % and two hexadecimal digits.
/// If `keep` rejects %, unescaped() is the reverse.
[[nodiscard]] std::string escaped(std::string_view name, std::predicate<char32_t> auto keep) {
  std::string text;
  while (!name.empty()) {
    const Character first = first_character(name);
    const std::string_view bytes = name.substr(0, std::max<std::size_t>(first.bytes, 1));
    if (first.bytes > 0 && keep(first.code)) {
      text += bytes;
    } else {
      constexpr const char* digits = "0123456789ABCDEF";
      for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        text.append({'%', digits[byte >> 4], digits[byte & 15]});
      }
    }
    name.remove_prefix(bytes.size());
  }
  return text;
}

}  // namespace roam::files
