#pragma once
/// \file
/// Sentences for people on standard error, made safe for terminals, without the secrets of addresses.

#include <string>
#include <string_view>

namespace roam::app {

/// One line: the program's name and the sentence, made printable.
void tell(std::string_view sentence, std::string_view program = "roam");

/// A text of several lines for people, each made printable. Make names printable before inserting them, or their line
/// breaks would count as the text's.
[[nodiscard]] std::string printable_lines(std::string_view text);

/// A file path, several paths, or an error reason, as a part of such a text.
[[nodiscard]] std::string printable_part(std::string_view text);

}  // namespace roam::app
