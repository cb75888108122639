#pragma once
/// \file
/// Formats from file names, and unescaped names.

#include <cctype>
#include <filesystem>
#include <string>

#include "files/extension.h"

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

}  // namespace roam::reader
