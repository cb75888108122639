#pragma once
/// \file
/// The commands of `roam view`: their keys and their actions. Keys that move are in src/osgroam/commands.cpp.

#include <functional>
#include <map>
#include <osgGA/GUIEventAdapter>
#include <string>
#include <utility>
#include <vector>

#include "graphics/hud.h"
#include "osgRoam/Controls.h"
#include "view/news.h"
#include "view/settings.h"

namespace roam::app {

/// The actions of the viewer's own commands. The objects that perform them add them; those of the body follow when it
/// is in the scene.
class Commands {
 public:
  explicit Commands(News& news) : news_(news) {}

  /// `name`: the command's name in the table of controls. `deed` gets whether Shift is down, or another key of "fast".
  void add(const std::string& name, std::function<void(bool shift)> deed) { deeds_[name] = std::move(deed); }
  void add(const std::string& name, const std::function<void()>& deed) {
    add(name, [deed](bool) { deed(); });
  }
  /// Runs the command, if it has an action now. Errors become news. False if it is no command of the viewer.
  bool run(const std::string& name, bool shift = false) const;

 private:
  News& news_;
  std::map<std::string, std::function<void(bool shift)>> deeds_;
};

[[nodiscard]] inline bool is_shift_down(const osgGA::GUIEventAdapter& event) {
  return (event.getModKeyMask() & osgGA::GUIEventAdapter::MODKEY_SHIFT) != 0;
}

/// Adds the viewer's commands to the manipulator's, then assigns the keys of the settings. Throws roam::Error with the
/// settings file's name for an unknown command or key, or for two commands on one key.
void set_up(osgRoam::Controls& controls, const ViewSettings& settings);

/// The keys of a command, for display; empty if it has none.
[[nodiscard]] std::string key_of(const osgRoam::Controls& controls, const char* command);

/// The line that a window begins with: "H: help     W A S D: walk     drag: look".
[[nodiscard]] std::string first_hint(const osgRoam::Controls& controls);

/// The table of keys, for display. Lines of commands that a key press runs, and of cameras, have the command's name.
/// `gamepad`: with the parts of a gamepad.
[[nodiscard]] std::vector<graphics::HelpLine> key_lines(const osgRoam::Controls& controls, bool gamepad = false);
/// The same as text: one line a command, with its name in the settings file.
[[nodiscard]] std::string key_table(const osgRoam::Controls& controls);

/// The cameras on the keys 1, 2, 3, ... by their names for display; the first is the body's.
[[nodiscard]] const std::vector<std::string>& camera_names();
/// The commands of the table for the first of them and for the others, whose keys are fixed.
inline constexpr const char* body_camera = "body_camera";
inline constexpr const char* other_cameras = "cameras";
[[nodiscard]] bool is_camera(const std::string& command);

}  // namespace roam::app
