#include "text/printable.h"

#include <array>
#include <cstdint>

namespace roam {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD
constexpr std::string_view ellipsis = "\xE2\x80\xA6";     // U+2026

bool is_blank(char32_t c) { return (c >= 0x09 && c <= 0x0D) || c == 0x85 || c == 0x2028 || c == 0x2029; }

/// Unicode's Bidi_Control.
bool turns_text(char32_t c) {
  return c == 0x061C || c == 0x200E || c == 0x200F || (c >= 0x202A && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
}

/// Unicode's other Default_Ignorable_Code_Point and Cf: nothing of them is seen.
bool is_invisible(char32_t c) {
  return c == 0x00AD || c == 0x034F || c == 0x115F || c == 0x1160 || c == 0x17B4 || c == 0x17B5 ||
         (c >= 0x180B && c <= 0x180F) || (c >= 0x200B && c <= 0x200D) || (c >= 0x2060 && c <= 0x206F) || c == 0x3164 ||
         (c >= 0xFE00 && c <= 0xFE0F) || c == 0xFEFF || c == 0xFFA0 || (c >= 0xFFF0 && c <= 0xFFFB) ||
         (c >= 0x1BCA0 && c <= 0x1BCA3) || (c >= 0x1D173 && c <= 0x1D17A) || (c >= 0xE0000 && c <= 0xE0FFF);
}

/// Codes that are no characters of any text, in Unicode's words: Cairo draws none.
bool is_no_character(char32_t c) { return (c & 0xFFFE) == 0xFFFE || (c >= 0xFDD0 && c <= 0xFDEF); }

struct Piece {
  std::string_view shown;
  std::size_t bytes = 1;  ///< of the text that `shown` stands for
};

Piece first_piece(std::string_view text) {
  const Character c = first_character(text);
  if (c.bytes == 0) return {replacement, 1};
  if (is_blank(c.code)) return {" ", c.bytes};
  if (is_control(c.code) || is_no_character(c.code)) return {replacement, c.bytes};
  return {text.substr(0, c.bytes), c.bytes};
}

std::size_t characters_of(std::string_view text) {
  std::size_t count = 0;
  for (; !text.empty(); ++count) text.remove_prefix(first_piece(text).bytes);
  return count;
}

}  // namespace

bool is_control(char32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || turns_text(code) || is_invisible(code);
}

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return {byte(0), 1};
  const std::size_t bytes = byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
  if (byte(0) < 0xC2 || byte(0) > 0xF4 || text.size() < bytes) return {};
  std::uint32_t code = byte(0) & (0x7FU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
  if (code < least[bytes] || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return {};
  return {code, bytes};
}

std::string printable(std::string_view text, std::size_t most) {
  const std::size_t count = characters_of(text);
  const bool whole = count <= most;
  const std::size_t begin = whole ? count : most / 2;                  // characters shown before the ellipsis
  const std::size_t end = whole ? count : count - (most - begin - 1);  // the first character shown after it
  std::string line;
  for (std::size_t i = 0; !text.empty(); ++i) {
    const Piece piece = first_piece(text);
    if (i < begin || i >= end) line += piece.shown;
    if (i == begin && i < end) line += ellipsis;
    text.remove_prefix(piece.bytes);
  }
  return line;
}

}  // namespace roam
