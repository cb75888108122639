#include "cli/help.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <memory>
#include <vector>

#include "cli/usage.h"

namespace roam::app {
namespace {

/// The column of descriptions.
constexpr std::size_t column = 24;

/// "  NAME   description"
std::string entry(const std::string& name, const std::string& description) {
  std::string line = "  " + name;
  if (line.size() + 2 > column) {
    line += '\n' + std::string(column, ' ');
  } else {
    line.resize(column, ' ');
  }
  return line + filled(description, help_width, column) + "\n";
}

bool takes_many(const CLI::Option& option) {
  return option.get_expected_max() >= CLI::detail::expected_max_vector_size;
}

std::string argument(const CLI::Option& option) { return option.get_name(true) + (takes_many(option) ? "..." : ""); }

/// "-o, --output FILE"
std::string option_name(const CLI::Option& option) {
  std::string name;
  for (const std::string& letter : option.get_snames()) name += "-" + letter + ", ";
  for (const std::string& word : option.get_lnames()) name += "--" + word + ", ";
  name.resize(name.size() - 2);
  const std::string value = option.get_type_size_max() == 0 ? std::string() : option.get_type_name();
  // SCENE may be given several times without the option's name; PATTERN may not.
  const bool many = takes_many(option) && option.get_allow_extra_args();
  return name + (value.empty() ? "" : " " + value + (many ? "..." : ""));
}

std::string description(const CLI::Option& option) {
  const std::string& preset = option.get_default_str();
  return option.get_description() + (preset.empty() ? "" : fmt::format(" (default: {})", preset));
}

std::vector<const CLI::Option*> options_of(const CLI::App& app, bool positional) {
  return app.get_options([=](const CLI::Option* option) { return option->get_positional() == positional; });
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
  std::string line = "Usage: " + full_name(app);
  if (!app.get_subcommands({}).empty()) {
    std::string noun = noun_below(app);
    std::transform(noun.begin(), noun.end(), noun.begin(), [](unsigned char c) { return std::toupper(c); });
    return line + " " + noun + " ...\n";
  }
  for (const CLI::Option* option : options_of(app, true)) {
    line += option->get_required() ? " " + argument(*option) : " [" + argument(*option) + "]";
  }
  for (const CLI::Option* option : options_of(app, false)) {
    if (option->get_required()) line += fmt::format(" {} {}", option->get_name(), option->get_type_name());
  }
  return line + " [OPTIONS]\n";
}

std::string section(const std::string& title, const std::string& entries) {
  return entries.empty() ? std::string() : fmt::format("\n{}:\n{}", title, entries);
}

class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string /*name*/, CLI::AppFormatMode /*mode*/) const override {
    std::string text = filled(app->get_description(), help_width) + "\n\n" + usage(*app);
    std::string entries;
    for (const CLI::Option* option : options_of(*app, true)) entries += entry(argument(*option), description(*option));
    if (!entries.empty()) text += "\n" + entries;
    entries.clear();
    for (const CLI::App* below : app->get_subcommands({}))
      entries += entry(below->get_name(), below->get_description());
    text += section(app->get_parent() == nullptr ? "Verbs" : "Kinds", entries);
    for (const std::string& group : groups(*app)) {
      entries.clear();
      for (const CLI::Option* option : options_of(*app, false)) {
        if (option->get_group() == group) entries += entry(option_name(*option), description(*option));
      }
      text += section(group, entries);
    }
    return text + "\n" + filled(app->get_footer(), help_width);
  }
};

}  // namespace

std::string filled(std::string_view text, std::size_t width, std::size_t indent) {
  const std::string margin(indent, ' ');
  std::string lines;
  std::size_t used = indent;
  const auto break_line = [&] {
    lines += '\n' + margin;
    used = indent;
  };
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const bool as_it_is = line.empty() || line.front() == ' ';
    if (as_it_is) {
      if (used > indent) break_line();
      lines += line;
      lines += '\n' + margin;
      continue;
    }
    while (!line.empty()) {
      const std::size_t blank = std::min(line.find(' '), line.size());
      const std::string_view word = line.substr(0, blank);
      line.remove_prefix(std::min(blank + 1, line.size()));
      if (used > indent && used + 1 + word.size() > width) break_line();
      if (used > indent) {
        lines += ' ';
        ++used;
      }
      lines += word;
      used += word.size();
    }
  }
  return lines;
}

void set_up_help(CLI::App& program) {
  program.formatter(std::make_shared<HelpFormatter>());
  program.set_help_flag("-h,--help", "Show this help")->group(other_group);
  for (CLI::App* below : program.get_subcommands({})) set_up_help(*below);
}

}  // namespace roam::app
