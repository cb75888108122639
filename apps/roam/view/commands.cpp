#include "view/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "roam/error.h"
#include "text/printable.h"
#include "view/gamepad.h"

namespace roam::app {
namespace {

using osgRoam::Controls;
using Kind = Controls::Kind;

struct Line {
  const char* name;
  const char* keys;
  const char* help;
};

constexpr Line lines[] = {
    {"help", "H", "shows or hides this menu"},
    {"hud", "F1", "changes the display: usual, all figures, one line, none"},
    {"measure", "T", "measures between clicked points"},
    {"probe", "I", "finds a way from A to B, the measured points"},
    {"section", "X", "hides the clicked surface and all before it; wheel: deeper"},
    {"section_box", "Ctrl+X", "shows only a box, with points to drag; wheel: smaller"},
    {"pass_hidden", "Ctrl+N", "lets the body through what is hidden, or no longer"},
    {"layers", "Ctrl+L", "lists objects and groups, to hide and show them"},
    {"plan", "L", "shows a plan: small, large, none; click: goes there"},
    {"marks", "V", "shows the body and what it touches"},
    {"edges", "K", "draws thin lines along edges, or not"},
    {"fullscreen", "F", "fills the screen, or leaves it"},
    {"bookmark", "B", "keeps this place as a bookmark"},
    {"name_bookmark", "Ctrl+B", "names the last bookmark"},
    {"bookmarks", "Ctrl+Tab", "lists the bookmarks; click: goes there"},
    {"next_bookmark", "Tab", "goes to the next bookmark; with Shift: back"},
    {"picture", "P, F12", "writes a picture, roam-1.png, into this folder"},
    {"picture_with_display", "Ctrl+P", "writes a picture with the display in it"},
    {"record", "R", "begins or ends recording the way, roam-1.path"},
    {"store", "O", "builds the scene's collision store, or stops that"},
    {"turn", "U", "turns the scene by 90 degrees"},
    {"unit", "Ctrl+U", "applies the file's unit, or the next of m, cm, mm, ft, in"},
    {"leave_out", "Delete", "leaves out the object ahead, for the body too"},
    {"show_all", "Ctrl+Delete", "shows all objects again"},
    {"adapt", "Y", "accepts the offered size of the body"},
    {"quit", "F10", "ends at once; so does Escape, pressed twice"},
};

/// Headings of the help, each with the first command below it.
constexpr std::pair<const char*, const char*> headings[] = {{"forward", "Move"}, {"grab", "Mouse"}, {"help", "View"}};

/// The keys as Controls::rebind reads them. Throws roam::Error for an unknown name.
std::vector<std::string> printed(const std::vector<std::string>& names, const std::string& file,
                                 const std::string& entry) {
  std::vector<std::string> keys;
  for (const std::string& name : names) {
    try {
      keys.push_back(Controls::print(Controls::parseKey(name)));
    } catch (const Error& error) {
      throw Error(file, fmt::format("{}: {}", entry, error.what()));
    }
  }
  return keys;
}

/// Throws if a command has a digit: with any modifiers, digits select the cameras.
void demand_free_digits(const Controls& controls) {
  for (const Controls::Command& command : controls.commands()) {
    for (const Controls::Key& key : command.keys) {
      if (key.symbol < '1' || key.symbol >= '1' + static_cast<int>(camera_names().size())) continue;
      throw Error(fmt::format("the key {} is wanted by both \"cameras\" and \"{}\"; give \"{}\" another key",
                              Controls::print(key), command.name, command.name));
    }
  }
}

}  // namespace

const std::vector<std::string>& camera_names() {
  static const std::vector<std::string> names = {"roam",    "trackball", "flight",       "drive",
                                                 "terrain", "orbit",     "first person", "spherical"};
  return names;
}

bool is_camera(const std::string& command) { return command == body_camera || command == other_cameras; }

bool Commands::run(const std::string& name, bool shift) const {
  if (std::none_of(std::begin(lines), std::end(lines), [&](const Line& line) { return line.name == name; }))
    return false;
  const auto found = deeds_.find(name);
  try {
    if (found != deeds_.end()) found->second(shift);
  } catch (const Error& error) {
    news_.note(error.what());
  }
  return true;
}

void set_up(osgRoam::Controls& controls, const ViewSettings& settings) {
  for (const Line& line : lines) controls.add(line.name, line.keys, line.help, Kind::pressed);
  controls.add(body_camera, "1", "shows what the body sees", Kind::gesture);
  controls.add(other_cameras, fmt::format("2 to {}", camera_names().size()),
               "other cameras, as in osgviewer, which meet no walls; click: the next one", Kind::gesture);
  std::string changes;
  for (const auto& [command, keys] : settings.keys) {
    const std::string file = settings.file.string(), entry = fmt::format("the entry \"keys.{}\"", excerpt(command));
    const Controls::Command* const known = controls.find(command);
    if (known == nullptr) throw Error(file, entry + ": there is no such command; `roam view --keys` lists them");
    if (known->kind == Kind::gesture) throw Error(file, entry + " is no command that can be given another key");
    changes += fmt::format("{} = {}\n", command, fmt::join(printed(keys, file, entry), ", "));
  }
  try {
    controls.rebind(changes);
    demand_free_digits(controls);
  } catch (const Error& error) {
    throw Error(settings.file.string(), fmt::format("keys: {}", error.what()));
  }
}

std::string key_of(const osgRoam::Controls& controls, const char* command) {
  const Controls::Command* const found = controls.find(command);
  return found == nullptr ? std::string() : Controls::keyText(*found);
}

std::string first_hint(const osgRoam::Controls& controls) {
  const auto first_key = [&](const char* command) {
    const Controls::Command* const found = controls.find(command);
    return found == nullptr || found->keys.empty() ? std::string() : Controls::print(found->keys.front());
  };
  const std::string help = first_key("help");
  std::vector<std::string> walk;
  for (const char* command : {"forward", "left", "back", "right"}) {
    if (std::string key = first_key(command); !key.empty()) walk.push_back(std::move(key));
  }
  std::string text = help.empty() ? help : help + ": help     ";
  if (!walk.empty()) text += fmt::format("{}: walk     ", fmt::join(walk, " "));
  return text + "drag: look";
}

std::vector<graphics::HelpLine> key_lines(const osgRoam::Controls& controls, bool gamepad) {
  std::vector<graphics::HelpLine> table;
  for (const auto& command : controls.commands()) {
    for (const auto& [first, heading] : headings) {
      if (command.name == first) table.push_back({heading, ""});
    }
    const std::string keys = osgRoam::Controls::keyText(command);
    const bool is_clickable = command.kind == Kind::pressed || is_camera(command.name);
    if (!keys.empty()) table.push_back({keys, command.help, is_clickable ? command.name : ""});
  }
  if (gamepad) {
    table.push_back({"Gamepad", ""});
    for (const auto& [part, effect] : gamepad_help()) table.push_back({part, effect, ""});
  }
  return table;
}

std::string key_table(const osgRoam::Controls& controls) {
  std::size_t name_width = 0, key_width = 0;
  for (const auto& command : controls.commands()) {
    name_width = std::max(name_width, command.name.size());
    key_width = std::max(key_width, osgRoam::Controls::keyText(command).size());
  }
  std::string text;
  for (const auto& command : controls.commands()) {
    text += fmt::format("{:<{}}  {:<{}}  {}\n", command.name, name_width, osgRoam::Controls::keyText(command),
                        key_width, command.help);
  }
  return text;
}

}  // namespace roam::app
