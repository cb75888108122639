#pragma once
/// \file
/// Where the program keeps what belongs to its user.

#include <cstdlib>
#include <filesystem>

namespace roam::app {

/// The folder `roam` in that of a variable of the XDG standard ("XDG_CONFIG_HOME"), else of `otherwise` in the home
/// (".config"). Empty when neither variable is set. A path that is not absolute is to be ignored.
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
