#pragma once
/// \file
/// Text of files (names, notes, the last words of other programs) as a person's terminal may see it. Data keep every
/// byte; it is sentences and reports that are made printable.

#include <cstddef>
#include <string>
#include <string_view>

namespace roam {

/// Characters of a name in a sentence, at most.
inline constexpr std::size_t longest_name = 120;
/// The same of a word of a file that is not what it should be: a link may lead to a secret.
inline constexpr std::size_t longest_excerpt = 24;
/// The same of a sentence that another process has made.
inline constexpr std::size_t longest_sentence = 600;

/// The character of UTF-8 that a text begins with: its code and how many bytes it has; 0 bytes where it begins with
/// none. The text is not empty.
struct Character {
  char32_t code = 0;
  std::size_t bytes = 0;
};
[[nodiscard]] Character first_character(std::string_view text);

/// Whether a terminal acts on it and shows nothing: the controls of C0 and C1, DEL, and Unicode's of direction.
[[nodiscard]] bool is_control(char32_t code);

/// One line of UTF-8 that moves no cursor and turns no text round: white space is a blank, other controls, C1 and
/// Unicode's of direction among them, and bytes that are no UTF-8 are U+FFFD. Of more than `most` characters those in
/// the middle become an ellipsis.
[[nodiscard]] std::string printable(std::string_view text, std::size_t most = longest_name);

}  // namespace roam
