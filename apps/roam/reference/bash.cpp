#include <fmt/format.h>

#include "reference/completion.h"

namespace roam::app {
namespace {

constexpr const char* bash_head = R"sh(# Completion of `roam` in bash, written from its help.

# Offers those of the words that begin with what was typed.
_roam_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur"); }

# Offers folders, and files with one of the endings: 'obj|stl'; all files without.
_roam_files() {
  if declare -F _filedir > /dev/null; then
    _filedir ${1:+"@($1)"}  # of bash-completion, which quotes names
    return
  fi
  local file
  compopt -o filenames
  while IFS= read -r file; do
    if [[ -z $1 || -d $file || ${file,,} =~ \.($1)$ ]]; then COMPREPLY+=("$file"); fi
  done < <(compgen -f -- "$cur")
}

_roam_folders() {
  compopt -o filenames
  mapfile -t COMPREPLY < <(compgen -d -- "$cur")
}

_roam() {
  local cur=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]} page=roam helping= i
  COMPREPLY=()
  # Readline makes three words of --mode=fly.
  if [[ $option == = && $COMP_CWORD -gt 1 ]]; then
    option=${COMP_WORDS[COMP_CWORD - 2]}
  elif [[ $cur == = ]]; then
    cur=
  fi
  # The verb, and the kind below it.
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "$page ${COMP_WORDS[i]}" in
      'roam help') helping=1 ;;
)sh";

std::string completer(const Completable& values, std::span<const std::string> scenes) {
  switch (values.kind) {
    case Completable::Kind::words:
      return fmt::format("_roam_words {}", shell_quoted(fmt::to_string(fmt::join(values.words, " "))));
    case Completable::Kind::files:
      return fmt::format("_roam_files {}", shell_quoted(fmt::to_string(fmt::join(values.words, "|"))));
    case Completable::Kind::scenes:
      return fmt::format("_roam_files {}", shell_quoted(fmt::to_string(fmt::join(scenes, "|"))));
    case Completable::Kind::folders:
      return "_roam_folders";
    case Completable::Kind::nothing:
      break;
  }
  return ":";
}

std::string names_below(const HelpPage& page) {
  std::string names;
  for (const HelpPage& below : page.below) names += below.name.substr(page.name.size() + 1) + " ";
  return names + (page.name.find(' ') == std::string::npos ? "help" : "");
}

}  // namespace

std::string bash_completion(const HelpPage& program, std::span<const std::string> scenes) {
  const std::vector<const HelpPage*> pages = all_pages(program);
  std::string script = bash_head;
  for (const HelpPage* page : pages) {
    if (page != &program)
      script += fmt::format("      {}) page={} ;;\n", shell_quoted(page->name), shell_quoted(page->name));
  }
  script += "    esac\n  done\n  # The value of an option.\n  case \"$page $option\" in\n";
  for (const HelpPage* page : pages) {
    for (const HelpEntry* entry : options_of(*page)) {
      if (entry->value.empty()) continue;
      std::string names;
      for (const std::string& name : entry->names) {
        if (!names.empty()) names += " | ";
        names += shell_quoted(page->name + " " + name);
      }
      script += fmt::format("    {}) {}; return ;;\n", names, completer(completable(*entry), scenes));
    }
  }
  script += "  esac\n  case $page in\n";
  for (const HelpPage* page : pages) {
    std::string options;
    for (const HelpEntry* entry : options_of(*page)) options += fmt::format("{} ", fmt::join(entry->names, " "));
    if (!options.empty()) options.pop_back();
    script += fmt::format("    {})\n", shell_quoted(page->name));
    if (!page->below.empty()) {
      script +=
          fmt::format("      if [[ $cur != -* ]]; then _roam_words {}; return; fi\n", shell_quoted(names_below(*page)));
    } else if (const HelpEntry* argument = argument_of(*page); argument != nullptr) {
      script += fmt::format("      if [[ $cur != -* && ! $helping ]]; then {}; return; fi\n",
                            completer(completable(*argument), scenes));
    }
    script += fmt::format("      [[ $helping ]] || _roam_words {}\n      ;;\n", shell_quoted(options));
  }
  return script + "  esac\n} && complete -F _roam roam\n";
}

}  // namespace roam::app
