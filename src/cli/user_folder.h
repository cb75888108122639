#pragma once
/// \file
/// The program's folders for the user's data.

#include <cstdlib>
#include <filesystem>

namespace roam::app {

/// The folder `roam` inside the one named by a variable of the XDG standard ("XDG_CONFIG_HOME"). Otherwise inside
/// `otherwise` (".config") in the home folder. Empty if neither variable is set. As the standard demands, relative
/// paths are ignored.
[[nodiscard]] inline std::filesystem::path user_folder(const char* variable, const char* otherwise) {
  const auto folder = [](const char* name) {
    const char* value = std::getenv(name);
    return std::filesystem::path(value == nullptr ? "" : value);
  };
  if (const auto named = folder(variable); named.is_absolute()) return named / "roam";
  if (const auto home = folder("HOME"); home.is_absolute()) return home / otherwise / "roam";
  return {};
}

}  // namespace roam::app
