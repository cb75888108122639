#include "cli/usage.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <string_view>

#include "cli/spelling.h"
#include "roam/error.h"

namespace roam::app {
namespace {

bool is_option(std::string_view word) { return word.size() > 1 && word.front() == '-'; }

/// Verbs of the program, kinds of a verb.
std::vector<std::string> names_below(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* sub : shown_below(app)) names.push_back(sub->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::string question(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string meant = likely_meant(word, candidates);
  return meant.empty() ? std::string() : fmt::format(" Did you mean '{}'?", meant);
}

Error unknown_option(const CLI::App& app, std::string_view word) {
  const std::string_view name = word.substr(0, word.find('='));
  const std::string asked = question(name, option_names(app));
  return Error::at(name, fmt::format("unknown option '{}'{}", name, asked.empty() ? "" : "." + asked));
}

Error unknown_name(const CLI::App& app, const std::string& word) {
  const std::vector<std::string> names = names_below(app);
  std::string asked = question(word, names);
  std::error_code none;
  const bool can_view = std::find(names.begin(), names.end(), "view") != names.end();
  if (asked.empty() && can_view && std::filesystem::exists(word, none))
    asked = fmt::format(" Did you mean '{} view {}'?", app.get_name(), word);
  if (asked.empty()) asked = fmt::format(" There is {}.", one_of_text(names));
  return Error(fmt::format("there is no {} '{}'.{}", noun_below(app), word, asked));
}

/// The option at the start of a message of CLI11.
const CLI::Option* subject(const CLI::App& app, std::string_view text) {
  const CLI::Option* found = nullptr;
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    if (!text.starts_with(name) || (found != nullptr && found->get_name().size() > name.size())) continue;
    const std::string_view rest = text.substr(name.size());
    if (rest.empty() || rest.front() == ':' || rest.front() == ' ') found = option;
  }
  return found;
}

/// "--from X,Y,Z"
std::string with_value(const CLI::Option& option) {
  const std::string value = option.get_type_name();
  return option.get_name() + (value.empty() ? "" : " " + value);
}

Error wrong_number_of_values(const CLI::Option& option) {
  const CLI::results_t& values = option.results();
  const std::string name = option.get_name();
  if (option.get_type_size_max() == 0) return Error::at(name, name + " takes no value");
  const int expected = option.get_expected_min();
  if (expected > 1) {
    return Error::at(
        name, fmt::format("{} needs {} numbers {}; got '{}'", name, expected == 3 ? "three" : std::to_string(expected),
                          option.get_type_name(), fmt::join(values, ",")));
  }
  if (values.empty()) return Error::at(name, fmt::format("{} needs a value: {}", name, with_value(option)));
  return Error::at(name, fmt::format("{} is given {} times; give it once", name, values.size()));
}

Error wrong_value(const CLI::Option& option) {
  if (option.get_type_size_max() == 0 || option.get_expected_min() > 1) return wrong_number_of_values(option);
  return {option.get_name(), fmt::format("'{}' is not a number", fmt::join(option.results(), ","))};
}

Error missing(const CLI::App& app, const std::string& text) {
  const CLI::Option* option = subject(app, text);
  if (option != nullptr) return Error::at(option->get_name(), with_value(*option) + " is missing");
  const std::vector<std::string> names = names_below(app);
  if (names.empty()) return Error(text);
  return Error(fmt::format("a {} is missing: {}", noun_below(app), one_of_text(names)));
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  if (at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

}  // namespace

const CLI::App& reached(const CLI::App& program) {
  const CLI::App* app = &program;
  while (!app->get_subcommands().empty()) app = app->get_subcommands().front();
  return *app;
}

std::string full_name(const CLI::App& app) {
  std::string name = app.get_name();
  for (const CLI::App* above = app.get_parent(); above != nullptr; above = above->get_parent()) {
    name = above->get_name() + " " + name;
  }
  return name;
}

const char* noun_below(const CLI::App& app) { return app.get_parent() == nullptr ? "verb" : "kind"; }

std::vector<const CLI::App*> shown_below(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* below) { return !below->get_group().empty(); });
}

std::string one_of_text(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool last = i + 1 == words.size();
    text += (i == 0 ? "" : last ? " or " : ", ") + words[i];
  }
  return text;
}

std::optional<UnknownWord> unknown_word(const CLI::App& program) {
  for (const CLI::App* app = &program;;) {
    std::vector<std::string> left = app->remaining(false);
    std::erase(left, "--");
    if (!left.empty() && !app->get_prefix_command()) {
      const std::string& word = left.front();
      if (is_option(word)) return UnknownWord{app, unknown_option(*app, word), true};
      if (names_below(*app).empty())
        return UnknownWord{app, Error::at(word, fmt::format("unexpected argument '{}'", word)), false};
      return UnknownWord{app, unknown_name(*app, word), false};
    }
    if (app->get_subcommands().empty()) return std::nullopt;
    app = app->get_subcommands().front();
  }
}

Error usage_error(const CLI::App& app, const CLI::ParseError& error) {
  const std::string text = error.what();
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) return missing(app, text);
  constexpr std::string_view conversion = "Could not convert: ";
  const CLI::Option* option = subject(app, replaced(text, conversion, ""));
  const std::string name = option != nullptr ? option->get_name() : std::string();
  if (dynamic_cast<const CLI::RequiresError*>(&error) != nullptr)
    return Error::at(name, replaced(text, " requires ", " needs "));
  if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr)
    return Error::at(name, replaced(text, " excludes ", " and ") + " exclude each other: leave one out");
  if (option != nullptr && dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) return wrong_value(*option);
  if (option != nullptr && dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
    return wrong_number_of_values(*option);
  return Error::at(name, text);
}

}  // namespace roam::app
