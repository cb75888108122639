#pragma once
/// \file
/// The text of `--help`.

#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace roam::app {

/// Columns of help, at most.
inline constexpr std::size_t help_width = 100;

/// Fills paragraphs up to `width` columns. Empty lines part paragraphs; lines that begin with a blank stay as they are.
/// Every line but the first begins with `indent` blanks.
[[nodiscard]] std::string filled(std::string_view text, std::size_t width, std::size_t indent = 0);

/// Groups of options, by purpose. Verbs name theirs by App::option_defaults()->group(); these two come last.
inline constexpr const char* scene_group = "Scene";
inline constexpr const char* other_group = "Other";

/// Gives `program` and its verbs help of this form: usage, arguments, groups of options, verbs, and the footer's
/// paragraphs, of which the last has examples. It shows names of values, but no rules: descriptions say them.
void set_up_help(CLI::App& program);

}  // namespace roam::app
