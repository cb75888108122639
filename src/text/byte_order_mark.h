#pragma once
/// \file
/// The byte order marks that editors on Windows put before text.

#include <string_view>

namespace roam {

inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

/// The text without a mark at its start.
[[nodiscard]] constexpr std::string_view without_byte_order_mark(std::string_view text) {
  return text.starts_with(byte_order_mark) ? text.substr(byte_order_mark.size()) : text;
}

/// Whether the marks before a text say UTF-16.
[[nodiscard]] constexpr bool is_utf16(std::string_view text) {
  return text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
}

}  // namespace roam
