#pragma once
/// \file
/// Formats from file names; names with escaped bytes.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <concepts>
#include <filesystem>
#include <string>
#include <string_view>

#include "files/extension.h"
#include "text/printable.h"

namespace roam::reader {

/// The extension in lower case, without the dot.
[[nodiscard]] inline std::string extension_of(const std::filesystem::path& path) {
  const std::string extension = files::lower_extension(path);
  return extension.empty() ? extension : extension.substr(1);
}

/// A name with each % and two hexadecimal digits replaced by a byte, as in addresses: "a%20room.bin" -> "a room.bin".
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
      for (const char c : bytes) text += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    name.remove_prefix(bytes.size());
  }
  return text;
}

}  // namespace roam::reader
