#pragma once
/// \file
/// What keys do in `roam view` beside moving: the lines that it adds to the manipulator's table, and their deeds.

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "osgRoam/Controls.h"
#include "view/news.h"
#include "view/settings.h"

namespace roam::app {

/// The deeds behind the commands that are the viewer's own. The objects that do them add them; those of the body are
/// added when it is in the scene.
class Commands {
 public:
  explicit Commands(News& news) : news_(news) {}

  /// `name`: of the table.
  void add(const std::string& name, std::function<void()> deed) { deeds_[name] = std::move(deed); }
  /// Does what the command does now, if anything; an error is news. False if the command is not the viewer's own.
  bool run(const std::string& name) const;

 private:
  News& news_;
  std::map<std::string, std::function<void()>> deeds_;
};

/// Adds the viewer's commands to the manipulator's, then gives all commands the keys of the settings. Throws
/// roam::Error, naming the settings file, for a command or key that does not exist or two commands on one key.
void set_up(osgRoam::Controls& controls, const ViewSettings& settings);

/// The keys of a command, for people; empty if it has none.
[[nodiscard]] std::string key_of(const osgRoam::Controls& controls, const char* command);

/// A key, or keys, and what they do; with an empty second, a heading.
using KeyLine = std::pair<std::string, std::string>;
/// The table for people.
[[nodiscard]] std::vector<KeyLine> key_lines(const osgRoam::Controls& controls);
/// The same as text, a line a command, with the command's name for the settings file.
[[nodiscard]] std::string key_table(const osgRoam::Controls& controls);

/// The cameras on the keys 1, 2, 3, ..., as people call them; the first is the body's.
[[nodiscard]] const std::vector<std::string>& camera_names();

}  // namespace roam::app
