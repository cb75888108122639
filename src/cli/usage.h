#pragma once
/// \file
/// Wrong command lines, in roam's words. Only this header and help.h know CLI11's messages.

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

#include "roam/error.h"

namespace roam::app {

/// The verb that the arguments reached, or the program.
[[nodiscard]] const CLI::App& reached(const CLI::App& program);

/// "roam make gallery"
[[nodiscard]] std::string full_name(const CLI::App& app);

/// The noun for names below `app`: "verb" or "kind".
[[nodiscard]] const char* noun_below(const CLI::App& app);

/// The verbs of a program, or kinds of a verb, without hidden ones: those in no group.
[[nodiscard]] std::vector<const CLI::App*> shown_below(const CLI::App& app);

/// "gallery, terrain or city"
[[nodiscard]] std::string one_of_text(const std::vector<std::string>& words);

struct UnknownWord {
  const CLI::App* app;  ///< the program or verb that does not know it
  Error error;          ///< names the word, and the likely one
  bool is_option;
};
/// The first word that parsing left over. Report misspelt words before all other errors, which they often cause.
[[nodiscard]] std::optional<UnknownWord> unknown_word(const CLI::App& program);

/// The error of CLI11 about the arguments of `app`, with its option: "--radius: 'abc' is not a number".
[[nodiscard]] Error usage_error(const CLI::App& app, const CLI::ParseError& error);

}  // namespace roam::app
