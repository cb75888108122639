#pragma once
/// \file
/// Wrong command lines, in roam's words. Together with help.h the only place that knows how CLI11 speaks.

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}

#include "roam/error.h"

namespace roam::app {

/// The verb that the arguments reached, or the program.
[[nodiscard]] const CLI::App& reached(const CLI::App& program);

/// "roam make gallery"
[[nodiscard]] std::string full_name(const CLI::App& app);

/// How names below `app` are called: "verb" or "kind".
[[nodiscard]] const char* noun_below(const CLI::App& app);

/// "gallery, terrain or city"
[[nodiscard]] std::string one_of_text(const std::vector<std::string>& words);

struct UnknownWord {
  const CLI::App* app;  ///< that does not know it
  Error error;          ///< names the word, and the one that was likely meant
  bool is_option;
};
/// The first word that parsing left over. Misspelt words come before all other complaints, because they often cause
/// them.
[[nodiscard]] std::optional<UnknownWord> unknown_word(const CLI::App& program);

/// The error of CLI11 about the arguments of `app`, with its option: "--radius: 'abc' is not a number".
[[nodiscard]] Error usage_error(const CLI::App& app, const CLI::ParseError& error);

}  // namespace roam::app
