#pragma once
/// \file
/// Texts that are kept to a length.

#include <cstddef>
#include <string>

namespace roam {

/// The first bytes of a text, `most` at most, cut between two characters of UTF-8.
[[nodiscard]] inline std::string cut_text(std::string text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t end = most;
  // A byte 10xxxxxx continues a character of UTF-8, which has at most four.
  for (int k = 0; k < 3 && end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80; ++k) --end;
  text.resize(end);
  text.shrink_to_fit();  // never throws, unlike a copy
  return text;
}

}  // namespace roam
