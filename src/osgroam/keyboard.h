#pragma once
/// \file
/// The keys that are down, and the changes of held commands since the last frame.

#include <set>
#include <string_view>
#include <vector>

#include "osgRoam/Controls.h"

namespace osgRoam {

/// Commands of the manipulator that act as long as a key is down.
struct HeldCommands {
  bool forward = false, back = false, left = false, right = false, up = false, down = false;
  bool fast = false, slow = false, crouch = false;

  [[nodiscard]] bool move() const { return forward || back || left || right || up || down; }
};

class Keyboard {
 public:
  /// A change of the commands. Times are those of the events.
  struct Change {
    double time = 0.0;  ///< seconds
    HeldCommands held;  ///< from then on
    bool jump = false;  ///< a jump was requested
  };

  /// Returns whether the key was up before; false for a repeated key. `symbol` is canonical.
  bool press(const Controls& controls, int symbol, double time);
  void release(const Controls& controls, int symbol, double time);
  void release_all(double time);
  void ask_to_jump(double time);

  [[nodiscard]] bool is_down(int symbol) const { return down_.contains(symbol); }
  [[nodiscard]] bool is_down(const Controls& controls, std::string_view command) const;
  [[nodiscard]] bool ctrl() const;
  /// The changes since the last call, in order of arrival. Their times may be out of order.
  [[nodiscard]] std::vector<Change> take_changes();
  [[nodiscard]] const HeldCommands& held() const { return held_; }

 private:
  void note(const Controls& controls, double time);

  std::set<int> down_;
  HeldCommands held_;
  std::vector<Change> changes_;
};

}  // namespace osgRoam
