#include "osgRoam/Controls.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <osgGA/GUIEventAdapter>

#include "text/printable.h"

namespace osgRoam {
namespace {

using Adapter = osgGA::GUIEventAdapter;

struct NamedKey {
  const char* name;
  int symbol;
};

/// Keys that have names instead of a character. The first name of a key is the printed one.
constexpr NamedKey named_keys[] = {
    {"Space", Adapter::KEY_Space},
    {"Comma", Adapter::KEY_Comma},
    {"Plus", Adapter::KEY_Plus},
    {"Hash", Adapter::KEY_Hash},
    {"Escape", Adapter::KEY_Escape},
    {"Esc", Adapter::KEY_Escape},
    {"Tab", Adapter::KEY_Tab},
    {"Return", Adapter::KEY_Return},
    {"Enter", Adapter::KEY_Return},
    {"BackSpace", Adapter::KEY_BackSpace},
    {"Delete", Adapter::KEY_Delete},
    {"Insert", Adapter::KEY_Insert},
    {"Home", Adapter::KEY_Home},
    {"End", Adapter::KEY_End},
    {"Page_Up", Adapter::KEY_Page_Up},
    {"PgUp", Adapter::KEY_Page_Up},
    {"Page_Down", Adapter::KEY_Page_Down},
    {"PgDn", Adapter::KEY_Page_Down},
    {"Left", Adapter::KEY_Left},
    {"Right", Adapter::KEY_Right},
    {"Up", Adapter::KEY_Up},
    {"Down", Adapter::KEY_Down},
    {"Shift", Adapter::KEY_Shift_L},
    {"Ctrl", Adapter::KEY_Control_L},
    {"Alt", Adapter::KEY_Alt_L},
    {"Menu", Adapter::KEY_Menu},
    {"Pause", Adapter::KEY_Pause},
    {"Print", Adapter::KEY_Print},
    {"Help", Adapter::KEY_Help},
    {"KP_Add", Adapter::KEY_KP_Add},
    {"KP_Subtract", Adapter::KEY_KP_Subtract},
    {"KP_Multiply", Adapter::KEY_KP_Multiply},
    {"KP_Divide", Adapter::KEY_KP_Divide},
    {"KP_Center", Adapter::KEY_KP_Begin},
    {"F1", Adapter::KEY_F1},
    {"F2", Adapter::KEY_F2},
    {"F3", Adapter::KEY_F3},
    {"F4", Adapter::KEY_F4},
    {"F5", Adapter::KEY_F5},
    {"F6", Adapter::KEY_F6},
    {"F7", Adapter::KEY_F7},
    {"F8", Adapter::KEY_F8},
    {"F9", Adapter::KEY_F9},
    {"F10", Adapter::KEY_F10},
    {"F11", Adapter::KEY_F11},
    {"F12", Adapter::KEY_F12},
};

/// Keys that count as another one: those of the right hand, and the keypad without Num Lock.
constexpr std::array<int, 2> same_keys[] = {
    {Adapter::KEY_Shift_R, Adapter::KEY_Shift_L},
    {Adapter::KEY_Control_R, Adapter::KEY_Control_L},
    {Adapter::KEY_Alt_R, Adapter::KEY_Alt_L},
    {Adapter::KEY_KP_Home, Adapter::KEY_Home},
    {Adapter::KEY_KP_End, Adapter::KEY_End},
    {Adapter::KEY_KP_Left, Adapter::KEY_Left},
    {Adapter::KEY_KP_Right, Adapter::KEY_Right},
    {Adapter::KEY_KP_Up, Adapter::KEY_Up},
    {Adapter::KEY_KP_Down, Adapter::KEY_Down},
    {Adapter::KEY_KP_Page_Up, Adapter::KEY_Page_Up},
    {Adapter::KEY_KP_Page_Down, Adapter::KEY_Page_Down},
    {Adapter::KEY_KP_Insert, Adapter::KEY_Insert},
    {Adapter::KEY_KP_Delete, Adapter::KEY_Delete},
    {Adapter::KEY_KP_Enter, Adapter::KEY_Return},
};

/// Characters of Latin-1, which X11 and Windows number as Unicode does. Space is excluded, because it has a name.
bool latin(int symbol) { return (symbol > 0x20 && symbol < 0x7F) || (symbol > 0xA0 && symbol <= 0xFF); }

std::string utf8(int latin_symbol) {
  if (latin_symbol < 0x80) return {static_cast<char>(latin_symbol)};
  return {static_cast<char>(0xC0 | (latin_symbol >> 6)), static_cast<char>(0x80 | (latin_symbol & 0x3F))};
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Calls `visit` with each part of `text` between separators.
template <class Visit>
void split(std::string_view text, char separator, const Visit& visit) {
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    visit(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return;
    begin = end + 1;
  }
}

std::vector<Controls::Key> parse_keys(std::string_view text) {
  std::vector<Controls::Key> keys;
  if (trimmed(text).empty()) return keys;
  split(text, ',', [&](std::string_view name) {
    const Controls::Key key = Controls::parseKey(trimmed(name));
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  });
  return keys;
}

/// Throws if a key belongs to two commands.
void demand_unambiguous(const std::vector<Controls::Command>& commands) {
  for (std::size_t i = 0; i < commands.size(); ++i) {
    for (const Controls::Key& key : commands[i].keys) {
      for (std::size_t j = 0; j < i; ++j) {
        const auto& others = commands[j].keys;
        if (std::find(others.begin(), others.end(), key) == others.end()) continue;
        throw roam::Error("the key " + Controls::print(key) + " is wanted by both \"" + commands[j].name + "\" and \"" +
                          commands[i].name + "\"; give one of them another key");
      }
    }
  }
}

bool one_word(std::string_view name) {
  return !name.empty() && name.find_first_of(" \t\r\n=#") == std::string_view::npos;
}

}  // namespace

int Controls::canonical(int symbol) {
  for (const auto& [other, one] : same_keys) {
    if (symbol == other) return one;
  }
  if (symbol >= 'A' && symbol <= 'Z') return symbol - 'A' + 'a';
  // The capitals of Latin-1, without the multiplication sign between them.
  if (symbol >= 0xC0 && symbol <= 0xDE && symbol != 0xD7) return symbol + 0x20;
  return symbol;
}

Controls::Key Controls::parseKey(std::string_view name) {
  const std::string wanted = lower(name);
  constexpr std::string_view ctrl = "ctrl+";
  if (wanted.starts_with(ctrl)) {
    const std::string_view rest = trimmed(name.substr(ctrl.size()));
    const auto twice = [&] { return roam::Error("\"" + roam::excerpt(name) + "\" names Ctrl twice"); };
    if (lower(rest).starts_with(ctrl)) throw twice();
    const Key key = parseKey(rest);
    if (key.symbol == Adapter::KEY_Control_L) throw twice();
    return {key.symbol, true};
  }
  for (const NamedKey& key : named_keys) {
    if (lower(key.name) == wanted) return {key.symbol, false};
  }
  for (int symbol = 0x21; symbol <= 0xFF; ++symbol) {
    if (latin(symbol) && utf8(symbol) == name) return {canonical(symbol), false};
  }
  throw roam::Error("there is no key \"" + roam::excerpt(name) +
                    "\"; keys are called W, 1, [, Up, Page_Down, Shift, F1, Space, Comma, Plus, Ctrl+1");
}

std::string Controls::print(const Key& key) {
  const std::string prefix = key.ctrl ? "Ctrl+" : "";
  for (const NamedKey& named : named_keys) {
    if (named.symbol == key.symbol) return prefix + named.name;
  }
  const bool small = key.symbol >= 'a' && key.symbol <= 'z';
  return prefix + utf8(small ? key.symbol - 'a' + 'A' : key.symbol);
}

std::string Controls::keyText(const Command& command) {
  std::string text = command.gesture;
  for (const Key& key : command.keys) text += (text.empty() ? "" : ", ") + print(key);
  return text;
}

void Controls::add(std::string_view name, std::string_view keys, std::string_view help, Kind kind) {
  if (!one_word(name)) throw roam::Error("\"" + std::string(name) + "\" is no name for a command: it must be one word");
  if (find(name)) throw roam::Error("there is a command \"" + std::string(name) + "\" already");
  std::vector<Command> changed = _commands;
  Command& added = changed.emplace_back(Command{std::string(name), std::string(help), kind, {}, {}});
  if (kind == Kind::gesture) {
    added.gesture = keys;
  } else {
    added.keys = parse_keys(keys);
  }
  demand_unambiguous(changed);
  _commands = std::move(changed);
}

void Controls::rebind(std::string_view lines) {
  std::vector<Command> changed = _commands;
  int number = 0;
  split(lines, '\n', [&](std::string_view line) {
    ++number;
    const auto refuse = [&](const std::string& why) {
      throw roam::Error("line " + std::to_string(number) + " of the keys", why);
    };
    const std::string_view content = trimmed(line.substr(0, line.find('#')));
    if (content.empty()) return;
    const std::size_t equals = content.find('=');
    if (equals == std::string_view::npos) {
      refuse("\"" + std::string(content) + "\" is not of the form \"forward = W, Up\"");
    }
    const std::string_view name = trimmed(content.substr(0, equals));
    const auto command = std::find_if(changed.begin(), changed.end(), [&](const Command& c) { return c.name == name; });
    if (command == changed.end()) refuse("there is no command \"" + std::string(name) + "\"");
    if (command->kind == Kind::gesture) {
      refuse("\"" + std::string(name) + "\" is done with the mouse and can not be given a key");
    }
    // In "zoom = =" the first sign is the separator and the second is the key.
    try {
      command->keys = parse_keys(content.substr(equals + 1));
    } catch (const roam::Error& error) {
      refuse(error.what());
    }
  });
  demand_unambiguous(changed);
  _commands = std::move(changed);
}

std::string Controls::text() const {
  std::string lines;
  for (const Command& command : _commands) {
    if (command.kind == Kind::gesture) continue;
    const std::string keys = keyText(command);
    lines += command.name + " =" + (keys.empty() ? "" : " " + keys) + "\n";
  }
  return lines;
}

const Controls::Command* Controls::find(std::string_view name) const {
  for (const Command& command : _commands) {
    if (command.name == name) return &command;
  }
  return nullptr;
}

const Controls::Command* Controls::lookup(int key, bool ctrl) const {
  const int symbol = canonical(key);
  const auto owner = [&](const Key& wanted) -> const Command* {
    for (const Command& command : _commands) {
      if (std::find(command.keys.begin(), command.keys.end(), wanted) != command.keys.end()) return &command;
    }
    return nullptr;
  };
  if (const Command* command = ctrl ? owner({symbol, true}) : nullptr) return command;
  return owner({symbol, false});
}

}  // namespace osgRoam
