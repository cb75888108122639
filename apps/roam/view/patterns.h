#pragma once
/// \file
/// Shell patterns of names.

#include <string>
#include <string_view>

namespace roam::app {

/// The pattern that matches this name alone.
[[nodiscard]] inline std::string pattern_of(const std::string& name) {
  std::string pattern;
  for (const char c : name) {
    if (std::string_view("*?[]\\").find(c) != std::string_view::npos) pattern += '\\';
    pattern += c;
  }
  return pattern;
}

}  // namespace roam::app
