#include "reference/completion.h"

#include <algorithm>
#include <cctype>

namespace roam::app {
namespace {

/// "svg" and "png" of "Draw a plan (.svg or .png)".
std::vector<std::string> endings_in(std::string_view description) {
  std::vector<std::string> endings;
  for (std::size_t at = description.find('.'); at != std::string_view::npos; at = description.find('.', at + 1)) {
    const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
    const auto* begin = description.begin() + at + 1;
    const auto* end = std::find_if_not(begin, description.end(), is_letter);
    const bool alone = at == 0 || description[at - 1] == ' ' || description[at - 1] == '(';
    if (begin != end && alone) endings.emplace_back(begin, end);
  }
  return endings;
}

void append_pages(const HelpPage& page, std::vector<const HelpPage*>& pages) {
  pages.push_back(&page);
  for (const HelpPage& below : page.below) append_pages(below, pages);
}

}  // namespace

Completable completable(const HelpEntry& entry) {
  const std::string& name = entry.is_option() ? entry.value : entry.names.front();
  if (!entry.choices.empty()) return {Completable::Kind::words, entry.choices};
  if (name == "FILE") return {Completable::Kind::files, endings_in(entry.description)};
  if (name == "SCENE") return {Completable::Kind::scenes, {}};
  if (name == "STORE" || name == "FOLDER" || name == "DIR") return {Completable::Kind::folders, {}};
  return {};
}

std::vector<const HelpPage*> all_pages(const HelpPage& program) {
  std::vector<const HelpPage*> pages;
  append_pages(program, pages);
  return pages;
}

std::vector<const HelpEntry*> options_of(const HelpPage& page) {
  std::vector<const HelpEntry*> options;
  for (const HelpSection& section : page.sections) {
    for (const HelpEntry& entry : section.entries) {
      if (entry.is_option()) options.push_back(&entry);
    }
  }
  return options;
}

const HelpEntry* argument_of(const HelpPage& page) {
  const bool has = !page.sections.empty() && page.sections.front().title.empty();
  return has ? &page.sections.front().entries.front() : nullptr;
}

std::string clause(const std::string& description) {
  return description.substr(0, std::min(description.find("; "), description.find(". ")));
}

std::string shell_quoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace roam::app
