#pragma once
/// \file
/// Formats from file names.

#include <filesystem>
#include <string>

#include "files/extension.h"

namespace roam::reader {

/// The extension in lower case, without the dot.
[[nodiscard]] inline std::string extension_of(const std::filesystem::path& path) {
  const std::string extension = files::lower_extension(path);
  return extension.empty() ? extension : extension.substr(1);
}

}  // namespace roam::reader
