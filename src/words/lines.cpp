#include "words/lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace roam::words {
namespace {

constexpr std::size_t columns = 100, label_columns = 14;

/// Characters, not bytes.
std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }));
}

/// With a full stop, and a capital at the beginning.
std::string sentence(std::string_view text) {
  std::string s(text);
  s[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(s[0])));
  return s.ends_with('.') ? s : s + '.';
}

}  // namespace

Lines::Lines(std::string_view first) : sentences_(sentence(first)) { wrap(first, 0); }

void Lines::add(std::string_view label, std::string_view text) {
  if (text.empty()) return;
  sentences_ += ' ' + (label.empty() ? sentence(text) : sentence(fmt::format("{}: {}", label, text)));
  text_ += fmt::format("  {:<{}}", label, label_columns - 2);
  if (label.size() + 2 >= label_columns) text_ += ' ';
  wrap(text, label_columns);
}

void Lines::wrap(std::string_view text, std::size_t indent) {
  std::size_t column = indent;
  for (bool is_first = true; !text.empty(); is_first = false) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    const std::size_t width = width_of(word);
    if (!is_first && column + 1 + width > columns) {
      column = std::max<std::size_t>(indent, 2);
      text_ += '\n' + std::string(column, ' ');
    } else if (!is_first) {
      text_ += ' ';
      ++column;
    }
    text_ += word;
    column += width;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  text_ += '\n';
}

}  // namespace roam::words
