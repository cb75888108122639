#pragma once
/// \file
/// Files that get their name when they are whole.

#include <unistd.h>

#include <filesystem>
#include <string>

namespace roam::graphics {

/// Where `path` is written until it is whole: beside it, so that renaming is one step, hidden, and with its extension,
/// by which writers choose the format.
[[nodiscard]] inline std::filesystem::path unfinished_name(const std::filesystem::path& path) {
  std::string name(1, '.');
  name += path.stem().string();
  name += '-';
  name += std::to_string(getpid());
  return path.parent_path() / (name + path.extension().string());
}

}  // namespace roam::graphics
