#include <fmt/format.h>

#include "reference/completion.h"

namespace roam::app {
namespace {

constexpr const char* fish_head = R"sh(# Completion of `roam` in fish, written from its help.

# Folders, and files with one of the endings; all files without.
function __roam_files
    set -l token (commandline -ct | string replace -r '^--[^=]*=' '')
    set -l endings (string join '|' -- $argv)
    if test -n "$endings"
        __fish_complete_path "$token" | string match -rei "(?:/|\.(?:$endings))(?:\t|\$)"
    else
        __fish_complete_path "$token"
    end
end

function __roam_folders
    __fish_complete_directories (commandline -ct | string replace -r '^--[^=]*=' '') ''
end

# Whether the words before the cursor lead to this verb or kind.
function __roam_at
    set -l page roam
    for word in (commandline -opc)[2..]
        if contains -- "$page $word" )sh";

/// In single quotes, in which fish knows \\ and \'.
std::string fish_quoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return out + "'";
}

std::string candidates(const Completable& values, std::span<const std::string> scenes) {
  switch (values.kind) {
    case Completable::Kind::words:
      return " -a " + fish_quoted(fmt::to_string(fmt::join(values.words, " ")));
    case Completable::Kind::files:
      return fmt::format(" -a '(__roam_files {})'", fmt::join(values.words, " "));
    case Completable::Kind::scenes:
      return fmt::format(" -a '(__roam_files {})'", fmt::join(scenes, " "));
    case Completable::Kind::folders:
      return " -a '(__roam_folders)'";
    case Completable::Kind::nothing:
      break;
  }
  return "";
}

}  // namespace

std::string fish_completion(const HelpPage& program, std::span<const std::string> scenes) {
  const std::vector<const HelpPage*> pages = all_pages(program);
  std::string script = fish_head;
  for (const HelpPage* page : pages) script += page == &program ? "" : fish_quoted(page->name) + " ";
  script += "\n            set page \"$page $word\"\n        end\n    end\n    test \"$page\" = \"$argv\"\nend\n\n";
  script += "complete -c roam -f\n";
  for (const HelpPage* page : pages) {
    const std::string line = fmt::format("complete -c roam -n '__roam_at {}'", page->name);
    for (const HelpPage& below : page->below) {
      script += fmt::format("{} -a {} -d {}\n", line, below.name.substr(page->name.size() + 1),
                            fish_quoted(below.description));
    }
    if (page == &program) script += line + " -a help -d 'Explain a verb'\n";
    if (const HelpEntry* argument = argument_of(*page); argument != nullptr) {
      script += fmt::format("{}{}\n", line, candidates(completable(*argument), scenes));
    }
    for (const HelpEntry* entry : options_of(*page)) {
      script += line;
      for (const std::string& name : entry->names) {
        script += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      }
      if (!entry->value.empty()) script += " -x" + candidates(completable(*entry), scenes);
      script += fmt::format(" -d {}\n", fish_quoted(clause(entry->description)));
    }
  }
  return script;
}

}  // namespace roam::app
