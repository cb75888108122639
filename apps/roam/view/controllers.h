#pragma once
/// \file
/// Gamepads and SpaceMice as the body's leaders.

#include <memory>

#include "view/gamepad.h"
#include "view/prompt.h"
#include "view/stage.h"

namespace roam::app {

/// Call all members from the thread that draws, between two frames.
class Controllers {
 public:
  /// `sensitivity`: of the mouse. While `prompt` asks, they do nothing.
  Controllers(Stage& stage, osgRoam::Manipulator& roamer, const Prompt& prompt, double sensitivity);

  /// Call it in each frame before the events. `leads`: the body's camera receives the keys. The devices are looked for
  /// at the first call in a window. Returns whether a gamepad came or went.
  [[nodiscard]] bool update(bool leads);
  [[nodiscard]] bool has_gamepad() const { return before_.present; }
  /// The effects of a gamepad and a SpaceMouse in these states.
  void take(const PadState& pad, const PuckState& puck, bool leads);

 private:
  Stage& stage_;
  osgRoam::Manipulator& roamer_;
  const Prompt& prompt_;
  double sensitivity_;
  std::unique_ptr<Gamepads> devices_;
  PadState before_;
};

}  // namespace roam::app
