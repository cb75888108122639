#pragma once
/// \file
/// A stream of a text for reading words and lines.

#include <ios>
#include <locale>
#include <sstream>
#include <string>

namespace roam {

/// Throws std::bad_alloc when memory runs out while it is read; streams otherwise just end there. Numbers have a point
/// in every locale.
[[nodiscard]] inline std::istringstream stream_of(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  stream.exceptions(std::ios::badbit);
  return stream;
}

}  // namespace roam
