#pragma once
/// \file
/// Words and numbers of text formats. fast_float parses numbers to the nearest double, in every locale.

#include <fast_float/fast_float.h>

#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

#include "text/printable.h"

namespace roam::reader {

inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

inline void skip_blanks(std::string_view& rest) {
  std::size_t n = 0;
  while (n < rest.size() && is_blank(rest[n])) ++n;
  rest.remove_prefix(n);
}

/// Removes the next word from a line and returns it; empty at the end of the line.
inline std::string_view take_word(std::string_view& rest) {
  skip_blanks(rest);
  std::size_t n = 0;
  while (n < rest.size() && !is_blank(rest[n])) ++n;
  const std::string_view word = rest.substr(0, n);
  rest.remove_prefix(n);
  return word;
}

inline std::string_view trimmed(std::string_view text) {
  skip_blanks(text);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// A word of a file, made short and printable for a message.
inline std::string shown(std::string_view word) {
  constexpr std::size_t length_limit = 40;
  return printable(word, length_limit);
}

/// Parses a word that is one number; false if it is not. Accepts "nan" and "inf". Numbers too large for a double become
/// infinite, and too small ones zero.
inline bool parse(std::string_view word, double& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = fast_float::from_chars(word.data(), word.data() + word.size(), value);
  return (error == std::errc() || error == std::errc::result_out_of_range) && end == word.data() + word.size() &&
         !word.empty();
}

/// Parses a word that is one integer; false if it is not.
inline bool parse(std::string_view word, std::int64_t& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && !word.empty();
}

}  // namespace roam::reader
