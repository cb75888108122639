#pragma once
/// \file
/// Words and numbers of text formats. Digits go through fast_float: the double nearest to what is written, whatever
/// the locale.

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

/// Takes the next word off a line; empty at its end.
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

/// A word of a file as a message may show it: short and printable.
inline std::string shown(std::string_view word) {
  constexpr std::size_t length_limit = 40;
  return printable(word, length_limit);
}

/// The number that all of `word` is. "nan" and "inf" are numbers; what is too large for a double is infinite, what is
/// too small is zero.
inline bool parse(std::string_view word, double& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = fast_float::from_chars(word.data(), word.data() + word.size(), value);
  return (error == std::errc() || error == std::errc::result_out_of_range) && end == word.data() + word.size() &&
         !word.empty();
}

/// The integer that all of `word` is.
inline bool parse(std::string_view word, std::int64_t& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && !word.empty();
}

}  // namespace roam::reader
