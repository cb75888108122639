#include "cli/help_page.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>

#include "cli/help.h"
#include "cli/usage.h"
#include "cli/values.h"

namespace roam::app {
namespace {

bool takes_many(const CLI::Option& option) {
  return option.get_expected_max() >= CLI::detail::expected_max_vector_size;
}

std::string argument(const CLI::Option& option) { return option.get_name(true) + (takes_many(option) ? "..." : ""); }

std::string description(const CLI::Option& option) {
  const std::string& preset = option.get_default_str();
  return option.get_description() + (preset.empty() ? "" : fmt::format(" (default: {})", preset));
}

std::vector<const CLI::Option*> options_of(const CLI::App& app, bool positional) {
  return app.get_options([=](const CLI::Option* option) { return option->get_positional() == positional; });
}

HelpEntry option_entry(const CLI::Option& option) {
  HelpEntry entry;
  for (const std::string& letter : option.get_snames()) entry.names.push_back("-" + letter);
  for (const std::string& word : option.get_lnames()) entry.names.push_back("--" + word);
  if (option.get_type_size_max() != 0) entry.value = option.get_type_name();
  // SCENE may be given several times without the option's name; PATTERN may not.
  entry.many = !entry.value.empty() && takes_many(option) && option.get_allow_extra_args();
  entry.description = description(option);
  entry.choices = choices_of(option);
  return entry;
}

/// In the order in which options were added, but Scene and Other last.
std::vector<std::string> groups(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options_of(app, false)) {
    if (option->get_group().empty()) continue;  // hidden in CLI11's sense
    if (std::find(names.begin(), names.end(), option->get_group()) == names.end()) names.push_back(option->get_group());
  }
  for (const char* last : {scene_group, other_group}) {
    std::stable_partition(names.begin(), names.end(), [=](const std::string& name) { return name != last; });
  }
  return names;
}

std::string usage(const CLI::App& app) {
  if (!shown_below(app).empty()) {
    std::string noun = noun_below(app);
    std::transform(noun.begin(), noun.end(), noun.begin(), [](unsigned char c) { return std::toupper(c); });
    return noun + " ...";
  }
  std::string line;
  for (const CLI::Option* option : options_of(app, true)) {
    line += (option->get_required() ? argument(*option) : "[" + argument(*option) + "]") + " ";
  }
  for (const CLI::Option* option : options_of(app, false)) {
    if (option->get_required()) line += fmt::format("{} {} ", option->get_name(), option->get_type_name());
  }
  return line + "[OPTIONS]";
}

}  // namespace

HelpPage help_page(const CLI::App& app) {
  HelpPage page{full_name(app), app.get_description(), usage(app), {}, app.get_footer(), {}};
  const auto add = [&](const std::string& title, std::vector<HelpEntry> entries) {
    if (!entries.empty()) page.sections.push_back({title, std::move(entries)});
  };
  std::vector<HelpEntry> arguments;
  for (const CLI::Option* option : options_of(app, true)) {
    arguments.push_back({{option->get_name(true)}, {}, takes_many(*option), description(*option), choices_of(*option)});
  }
  add("", std::move(arguments));
  std::vector<HelpEntry> names;
  for (const CLI::App* below : shown_below(app)) {
    names.push_back({{below->get_name()}, {}, false, below->get_description(), {}});
    page.below.push_back(help_page(*below));
  }
  add(app.get_parent() == nullptr ? "Verbs" : "Kinds", std::move(names));
  for (const std::string& group : groups(app)) {
    std::vector<HelpEntry> entries;
    for (const CLI::Option* option : options_of(app, false)) {
      if (option->get_group() == group) entries.push_back(option_entry(*option));
    }
    add(group, std::move(entries));
  }
  return page;
}

}  // namespace roam::app
