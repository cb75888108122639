#pragma once
/// \file
/// Controls: the table of commands and their keys, for the manipulator, help texts and settings files.
///
///     osgRoam::Controls& controls = manipulator->controls();
///     controls.add("help", "H", "shows or hides this help", osgRoam::Controls::Kind::pressed);
///     controls.rebind("forward = Z, Up\nleft = Q, Left\ndown = Page_Down");  // a French keyboard
///     std::cout << controls.text();
///
/// A command has any number of keys; a key belongs to one command. Keys have the names printed on them, in either case:
/// "W", "1", "[", "Up", "Page_Down", "Shift", "F1", "Space", "Comma", "Plus", "Ctrl+1". Left and right Shift, Ctrl and
/// Alt are one key each; the keypad without Num Lock counts as the keys that it stands for.
///
/// References to commands are valid until the next add() or rebind(). Not thread-safe.

#include <compare>
#include <string>
#include <string_view>
#include <vector>

#include "roam/error.h"

namespace osgRoam {

class Controls {
 public:
  /// held: works while a key is down. pressed: works once per key press. gesture: of the mouse, listed for help texts.
  enum class Kind { held, pressed, gesture };

  /// A key: osgGA::GUIEventAdapter::KeySymbol without Shift, alone or with Ctrl.
  struct Key {
    int symbol = 0;
    bool ctrl = false;
    friend auto operator<=>(const Key&, const Key&) = default;
  };

  struct Command {
    std::string name;  ///< one word: "forward"
    std::string help;  ///< "walks or flies forward"
    Kind kind = Kind::pressed;
    std::vector<Key> keys;  ///< may be empty
    std::string gesture;    ///< for a gesture: "Drag"
  };

  /// Appends a command with its keys, such as "W, Up", or its gesture. Throws roam::Error if the name exists or is not
  /// one word, or if a key is unknown or belongs to another command.
  void add(std::string_view name, std::string_view keys, std::string_view help, Kind kind);

  /// Gives commands other keys, one line each: "forward = W, Up"; "forward =" for none. Empty lines and text after #
  /// are ignored. All lines are one change, so keys can be swapped. Throws roam::Error, and changes nothing, for an
  /// unknown command or key, a gesture, and two commands on one key.
  void rebind(std::string_view lines);

  /// The table as rebind() reads it, without gestures.
  [[nodiscard]] std::string text() const;

  [[nodiscard]] const std::vector<Command>& commands() const { return _commands; }
  /// Null if there is no such command.
  [[nodiscard]] const Command* find(std::string_view name) const;
  /// The command of a key, or null. `key` is osgGA::GUIEventAdapter::getUnmodifiedKey(), or getKey() if that is 0. With
  /// Ctrl, "Ctrl+W" is tried before "W".
  [[nodiscard]] const Command* lookup(int key, bool ctrl) const;

  /// Keys or gesture of a command: "W, Up", "Drag"; may be empty.
  [[nodiscard]] static std::string keyText(const Command& command);
  /// "W", "Ctrl+1": the reverse of parseKey().
  [[nodiscard]] static std::string print(const Key& key);
  /// Throws roam::Error for an unknown name.
  [[nodiscard]] static Key parseKey(std::string_view name);
  /// The symbol of a key without Shift, Caps Lock and Num Lock: 'W' becomes 'w', right Shift left Shift.
  [[nodiscard]] static int canonical(int symbol);

 private:
  std::vector<Command> _commands;
};

}  // namespace osgRoam
