#pragma once
/// \file
/// Completion of command lines: a script for each shell, written from the help.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/help_page.h"

namespace roam::app {

/// The script for a shell. `scenes` are the endings of scene files, such as "obj". Options, verbs and values are
/// those of the help. Files are offered by their endings: of scenes for SCENE, and those that a FILE's description
/// names.
[[nodiscard]] std::string bash_completion(const HelpPage& program, std::span<const std::string> scenes);
[[nodiscard]] std::string zsh_completion(const HelpPage& program, std::span<const std::string> scenes);
[[nodiscard]] std::string fish_completion(const HelpPage& program, std::span<const std::string> scenes);

/// Values that a shell can complete.
struct Completable {
  enum class Kind {
    nothing,  ///< a number, a name: only the user knows it
    words,    ///< these
    files,    ///< files with these endings, of any if there are none; folders on the way to them
    scenes,   ///< scene files, stores and folders of tiles
    folders,
  };
  Kind kind = Kind::nothing;
  std::vector<std::string> words;
};
/// The values of an option, or the words that may stand for an argument.
[[nodiscard]] Completable completable(const HelpEntry& entry);

/// The page and all below it: "roam", "roam view", "roam make", "roam make gallery"...
[[nodiscard]] std::vector<const HelpPage*> all_pages(const HelpPage& program);

[[nodiscard]] std::vector<const HelpEntry*> options_of(const HelpPage& page);
/// Null if it takes none.
[[nodiscard]] const HelpEntry* argument_of(const HelpPage& page);

/// The first clause of a description, which fits in a line.
[[nodiscard]] std::string clause(const std::string& description);

/// `text` in single quotes, for a POSIX shell or zsh.
[[nodiscard]] std::string shell_quoted(std::string_view text);

}  // namespace roam::app
