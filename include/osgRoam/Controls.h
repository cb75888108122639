#pragma once
/// \file
/// The one table of what keys do: the manipulator looks keys up in it, and help texts, settings files and manuals are
/// written from it.
///
///     osgRoam::Controls& controls = manipulator->controls();
///     controls.add("help", "H", "shows or hides this help", osgRoam::Controls::Kind::pressed);
///     controls.rebind("forward = Z, Up\nleft = Q, Left\ndown = Page_Down");   // a French keyboard
///     std::cout << controls.text();
///
/// A command has a name of its own, and any number of keys; a key belongs to one command. Keys are named by what is
/// printed on them without Shift: "W", "1", "[", "Up", "Page_Down", "Shift", "F1", "Space", "Ctrl+1". Left and right
/// Shift, Ctrl and Alt are one key each, and the keypad without Num Lock is the keys it stands for. Names are read in
/// either case; "Comma" and "Plus" are words, since the characters part keys from each other.
///
/// A Command that commands(), find() or lookup() leads to is where it is until the next add() or rebind(): copy what is
/// to be kept.
///
/// Not for several threads at a time.

#include <compare>
#include <string>
#include <string_view>
#include <vector>

#include "roam/error.h"

namespace osgRoam {

class Controls {
 public:
  /// held: works as long as a key is down. pressed: works once each time a key goes down. gesture: of the mouse; in the
  /// table so that people are told of it, but no key.
  enum class Kind { held, pressed, gesture };

  /// A key of the keyboard: osgGA::GUIEventAdapter::KeySymbol without Shift, and whether Ctrl is down with it.
  struct Key {
    int symbol = 0;
    bool ctrl = false;
    friend auto operator<=>(const Key&, const Key&) = default;
  };

  struct Command {
    std::string name;  ///< one word: "forward"
    std::string help;  ///< what it does, for people: "walks or flies forward"
    Kind kind = Kind::pressed;
    std::vector<Key> keys;  ///< may be empty: then nothing calls it
    std::string gesture;    ///< of a gesture: "Drag"
  };

  /// Adds a command at the end of the table, with its keys as in "W, Up"; of a gesture its name as people call it.
  /// Throws roam::Error for a name that is there already or is not one word, for a key that is unknown, and for a key
  /// that another command has.
  void add(std::string_view name, std::string_view keys, std::string_view help, Kind kind);

  /// Gives commands other keys, one line a command: "forward = W, Up". "forward =" takes all keys from it. Empty lines
  /// and what follows a # are left out. All lines together are one change, so that keys can be swapped. Throws
  /// roam::Error, and changes nothing, for an unknown command or key (naming the line), a gesture, and two commands on
  /// one key (naming both).
  void rebind(std::string_view lines);

  /// The table as rebind() reads it, gestures left out.
  [[nodiscard]] std::string text() const;

  [[nodiscard]] const std::vector<Command>& commands() const { return _commands; }
  /// Null when there is no such command. Ends with the next add() or rebind().
  [[nodiscard]] const Command* find(std::string_view name) const;
  /// The command of a key, or null; ends likewise. `key` as osgGA::GUIEventAdapter::getUnmodifiedKey() says it, or
  /// getKey() where that is 0. With Ctrl down "Ctrl+W" comes first and "W" second.
  [[nodiscard]] const Command* lookup(int key, bool ctrl) const;

  /// What people press for a command: "W, Up", "Drag"; empty when nothing calls it.
  [[nodiscard]] static std::string keyText(const Command& command);
  /// "W", "Ctrl+1": what parseKey() reads.
  [[nodiscard]] static std::string print(const Key& key);
  /// Throws roam::Error for an unknown name.
  [[nodiscard]] static Key parseKey(std::string_view name);
  /// The symbol that stands for a key whatever Shift, Caps Lock and Num Lock do to it: 'W' becomes 'w', right Shift
  /// left Shift, the keypad's Up Up.
  [[nodiscard]] static int canonical(int symbol);

 private:
  std::vector<Command> _commands;
};

}  // namespace osgRoam
