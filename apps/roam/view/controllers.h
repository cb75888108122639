#pragma once
/// \file
/// Gamepads and SpaceMice as the body's leaders.

#include <memory>

#include "view/gamepad.h"
#include "view/prompt.h"

namespace roam::app {

class Session;

/// Call all members from the thread that draws, between two frames.
class Controllers {
 public:
  /// `sensitivity`: of the mouse. While `prompt` asks, they do nothing.
  Controllers(Session& session, const Prompt& prompt, double sensitivity)
      : session_(session), prompt_(prompt), sensitivity_(sensitivity) {}

  /// Call it in each frame before the events. The devices are looked for at the first call in a window. Returns whether
  /// a gamepad came or went.
  [[nodiscard]] bool update();
  [[nodiscard]] bool has_gamepad() const { return before_.present; }
  /// The effects of a gamepad and a SpaceMouse in these states.
  void take(const PadState& pad, const PuckState& puck);

 private:
  Session& session_;
  const Prompt& prompt_;
  double sensitivity_;
  std::unique_ptr<Gamepads> devices_;
  PadState before_;
};

}  // namespace roam::app
