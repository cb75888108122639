#pragma once
/// \file
/// By what a file's format is known.

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace roam::reader {

/// In lower case and without the dot.
[[nodiscard]] inline std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace roam::reader
