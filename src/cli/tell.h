#pragma once
/// \file
/// Sentences for people on standard error, and what of them a terminal sees.

#include <string>
#include <string_view>

namespace roam::app {

/// One line: the program's name and the sentence, made printable.
void tell(std::string_view sentence, std::string_view program = "roam");

/// A text of several lines for people, each made printable. A name in it is made so before, or its own line breaks
/// would count as the text's.
[[nodiscard]] std::string printable_lines(std::string_view text);

/// The path of a file, several, or what says why not, as a part of such a text.
[[nodiscard]] std::string printable_part(std::string_view text);

}  // namespace roam::app
