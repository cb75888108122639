#pragma once
/// \file
/// Names of spatial reference systems.

#include <cctype>
#include <string>
#include <string_view>

#include "text/printable.h"

namespace roam {

/// One line that names a reference system: the name that a definition in WKT begins with, PROJCS["name", ...; any other
/// text, such as EPSG:25832, as it is.
[[nodiscard]] inline std::string reference_name(std::string_view srs) {
  std::size_t word = 0;
  while (word < srs.size() && (std::isalnum(static_cast<unsigned char>(srs[word])) != 0 || srs[word] == '_')) ++word;
  const std::size_t bracket = srs.find_first_not_of(" \t\r\n", word);
  if (word == 0 || bracket == std::string_view::npos || (srs[bracket] != '[' && srs[bracket] != '(')) {
    return printable(srs);
  }
  const std::size_t begin = srs.find_first_not_of(" \t\r\n", bracket + 1);
  if (begin == std::string_view::npos || srs[begin] != '"') return printable(srs);
  const std::size_t end = srs.find('"', begin + 1);
  if (end == std::string_view::npos || end == begin + 1) return printable(srs);
  return printable(srs.substr(begin + 1, end - begin - 1));
}

}  // namespace roam
