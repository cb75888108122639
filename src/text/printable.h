#pragma once
/// \file
/// Text of files and of other programs, made safe for a terminal: names, notes, last words. Data keep every byte; only
/// sentences and reports are made printable.

#include <cstddef>
#include <string>
#include <string_view>

namespace roam {

/// Most characters of a name in a sentence.
inline constexpr std::size_t longest_name = 120;
/// Most characters of a sentence from another process.
inline constexpr std::size_t longest_sentence = 600;

/// The first UTF-8 character of a text: its code and its number of bytes. `bytes` is 0 where the text begins with
/// invalid UTF-8. The text must not be empty.
struct Character {
  char32_t code = 0;
  std::size_t bytes = 0;
};
[[nodiscard]] Character first_character(std::string_view text);

/// Whether a terminal shows nothing for the character: controls of C0 and C1, DEL, and Unicode's controls of direction
/// and other invisible characters.
[[nodiscard]] bool is_control(char32_t code);

/// One line of valid UTF-8 that moves no cursor and changes no direction. White space becomes a blank. Other controls,
/// noncharacters and invalid bytes become U+FFFD. If the text has more than `most` characters, an ellipsis replaces
/// those in the middle.
[[nodiscard]] std::string printable(std::string_view text, std::size_t most = longest_name);
/// The same for an excerpt from a malformed file: 24 characters, because a link may lead to a secret.
[[nodiscard]] inline std::string excerpt(std::string_view text) { return printable(text, 24); }

}  // namespace roam
