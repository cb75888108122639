#pragma once
/// \file
/// Extensions of files, which say their formats.

#include <algorithm>
#include <filesystem>
#include <string>

namespace roam::files {

/// ".ply" of "A.PLY": the extension with its dot, in lower case as far as it is ASCII.
[[nodiscard]] inline std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

}  // namespace roam::files
