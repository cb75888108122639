#include <fmt/format.h>

#include <algorithm>

#include "reference/completion.h"

namespace roam::app {
namespace {

/// A word or sentence in a specification of _arguments, in which brackets, colons and backslashes have a meaning.
std::string plain(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string action(const Completable& values, std::span<const std::string> scenes) {
  const auto files = [](auto endings) { return fmt::format("_files -g \"(#i)*.({})\"", fmt::join(endings, "|")); };
  switch (values.kind) {
    case Completable::Kind::words:
      return fmt::format("({})", fmt::join(values.words, " "));
    case Completable::Kind::files:
      return values.words.empty() ? "_files" : files(values.words);
    case Completable::Kind::scenes:
      return files(scenes);
    case Completable::Kind::folders:
      return "_files -/";
    case Completable::Kind::nothing:
      break;
  }
  return " ";
}

/// The name of the function for a page: "_roam_make_gallery".
std::string function_of(const HelpPage& page) {
  std::string name = "_" + page.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::string specifications(const HelpPage& page, std::span<const std::string> scenes) {
  std::string text;
  const auto add = [&](const std::string& specification) { text += " \\\n    " + shell_quoted(specification); };
  for (const HelpEntry* entry : options_of(page)) {
    for (const std::string& name : entry->names) {
      const std::string values =
          entry->value.empty() ? "" : fmt::format(":{}:{}", plain(entry->value), action(completable(*entry), scenes));
      const char* const joined = entry->value.empty() ? "" : name.starts_with("--") ? "=" : "+";
      add(fmt::format("({}){}{}[{}]{}", fmt::join(entry->names, " "), name, joined, plain(clause(entry->description)),
                      values));
    }
  }
  if (const HelpEntry* argument = argument_of(page); argument != nullptr) {
    add(fmt::format("{}:{}:{}", argument->many ? "*" : "1", plain(argument->names.front()),
                    action(completable(*argument), scenes)));
  }
  return text;
}

std::string name_below(const HelpPage& page, const HelpPage& below) { return below.name.substr(page.name.size() + 1); }

std::string function(const HelpPage& page, std::span<const std::string> scenes) {
  const bool is_program = page.name.find(' ') == std::string::npos;
  std::string text = fmt::format("\n{}() {{\n", function_of(page));
  if (page.below.empty()) {
    return text + fmt::format("  _arguments -s -S :{}\n}}\n", specifications(page, scenes));
  }
  text += "  local curcontext=$curcontext state line\n  local -a names=(\n";
  for (const HelpPage& below : page.below) {
    text += fmt::format("    {}\n", shell_quoted(name_below(page, below) + ":" + plain(below.description)));
  }
  if (is_program) text += "    'help:Explain a verb'\n";
  text += fmt::format("  )\n  _arguments -C :{} '1: :->name' '*:: :->rest' && return\n", specifications(page, scenes));
  text +=
      fmt::format("  case $state in\n    name) _describe -t names {} names ;;\n    rest)\n      case $words[1] in\n",
                  is_program ? "verb" : "kind");
  for (const HelpPage& below : page.below) {
    text += fmt::format("        {}) {} ;;\n", name_below(page, below), function_of(below));
  }
  if (is_program) text += fmt::format("        help) {} ;;\n", function_of(page));
  return text + "      esac\n      ;;\n  esac\n}\n";
}

}  // namespace

std::string zsh_completion(const HelpPage& program, std::span<const std::string> scenes) {
  std::string script =
      fmt::format("#compdef {}\n# Completion of `{}` in zsh, written from its help.\n", program.name, program.name);
  for (const HelpPage* page : all_pages(program)) script += function(*page, scenes);
  return script + fmt::format("\n{} \"$@\"\n", function_of(program));
}

}  // namespace roam::app
