#pragma once
/// \file
/// The help of a program as data: for `--help`, for man pages, for completion.

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace roam::app {

/// An argument, an option, or a verb.
struct HelpEntry {
  std::vector<std::string> names;    ///< "-o" and "--output"; "SCENE"; "walk"
  std::string value;                 ///< name of an option's value; empty: it has none, or this is no option
  bool many = false;                 ///< an argument, or a value, that may be repeated
  std::string description;           ///< with the default
  std::vector<std::string> choices;  ///< all values, if they are few words; else empty

  [[nodiscard]] bool is_option() const { return names.front().front() == '-'; }
};

struct HelpSection {
  std::string title;  ///< empty for arguments
  std::vector<HelpEntry> entries;
};

struct HelpPage {
  std::string name;         ///< "roam make city"
  std::string description;  ///< one line
  std::string usage;        ///< after the name: "SCENE... [OPTIONS]"
  std::vector<HelpSection> sections;
  std::string footer;           ///< paragraphs, as `filled` takes them
  std::vector<HelpPage> below;  ///< verbs or kinds, in their order
};

/// The pages of a program or verb and of all that is below it. Hidden verbs and options are left out.
[[nodiscard]] HelpPage help_page(const CLI::App& app);

}  // namespace roam::app
