#include "cli/help.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "cli/help_page.h"

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

/// "-o, --output FILE", "SCENE...", "walk"
std::string name_of(const HelpEntry& entry) {
  return fmt::format("{}{}{}{}", fmt::join(entry.names, ", "), entry.value.empty() ? "" : " ", entry.value,
                     entry.many ? "..." : "");
}

class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string /*name*/, CLI::AppFormatMode /*mode*/) const override {
    const HelpPage page = help_page(*app);
    std::string text = fmt::format("{}\n\nUsage: {} {}\n", filled(page.description, help_width), page.name, page.usage);
    for (const HelpSection& section : page.sections) {
      text += section.title.empty() ? "\n" : fmt::format("\n{}:\n", section.title);
      for (const HelpEntry& shown : section.entries) text += entry(name_of(shown), shown.description);
    }
    return text + "\n" + filled(page.footer, help_width);
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
