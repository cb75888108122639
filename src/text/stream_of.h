#pragma once
/// \file
/// Words and parts of a text. Where memory runs out, all throw std::bad_alloc.

#include <ios>
#include <locale>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace roam {

/// Throws std::bad_alloc when memory runs out while it is read; streams otherwise just end there. Numbers have a point
/// in every locale.
[[nodiscard]] inline std::istringstream stream_of(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  stream.exceptions(std::ios::badbit);
  return stream;
}

/// The parts between separators, as std::getline gives them: a separator at the end begins no other part.
[[nodiscard]] inline std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream = stream_of(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(std::move(part));
  return parts;
}

}  // namespace roam
