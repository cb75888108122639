#pragma once
/// \file
/// Gamepads (by SDL) and SpaceMice (by libspnav), where roam was built with these libraries.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "osgRoam/Manipulator.h"

namespace roam::app {

/// Buttons of a gamepad, by their places on an Xbox controller.
enum class PadButton : std::uint8_t { a, b, x, y, back, start, left_stick, right_stick, left_shoulder, right_shoulder };
inline constexpr std::size_t pad_buttons = 10;

/// A gamepad as its driver reports it.
struct PadState {
  bool present = false;
  std::array<double, 2> left{}, right{};           ///< sticks: to the right and down, in [-1, 1]
  double left_trigger = 0.0, right_trigger = 0.0;  ///< in [0, 1]
  std::array<bool, pad_buttons> buttons{};
  [[nodiscard]] bool is_down(PadButton button) const { return buttons[static_cast<std::size_t>(button)]; }
};

/// A SpaceMouse: shares of its full deflection, in [-1, 1].
struct PuckState {
  bool present = false;
  double right = 0.0, up = 0.0, forward = 0.0;
  double turn_left = 0.0, look_up = 0.0;
};

/// Sticks within this share of their range are at rest: worn ones do not return to 0.
inline constexpr double dead_zone = 0.18;

/// What a gamepad wishes. The left stick walks, the right one looks, the triggers rise (right) and sink, the left
/// shoulder hurries, the right one goes slowly, B crouches. `sensitivity` and `inverted` are those of the mouse.
[[nodiscard]] osgRoam::Manipulator::Axes axes_of(const PadState& pad, double sensitivity, bool inverted);
[[nodiscard]] osgRoam::Manipulator::Axes axes_of(const PuckState& puck, double sensitivity);
/// The command that a button presses as a key does; null for those that axes_of() uses.
[[nodiscard]] const char* command_of(PadButton button);
/// The sum of two devices' wishes.
[[nodiscard]] osgRoam::Manipulator::Axes sum_of(const osgRoam::Manipulator::Axes& a,
                                                const osgRoam::Manipulator::Axes& b);

/// Parts of a gamepad or SpaceMouse, and their effects, for the help.
[[nodiscard]] std::span<const std::pair<const char*, const char*>> gamepad_help();

/// The devices that are plugged in now. They may come and go. Reads them also while another window has the keyboard,
/// takes no signals, and opens neither a display nor a sound card. Use one at a time, from one thread.
class Gamepads {
 public:
  Gamepads();
  ~Gamepads();
  Gamepads(const Gamepads&) = delete;
  Gamepads& operator=(const Gamepads&) = delete;

  /// Whether roam was built with a library for them.
  [[nodiscard]] static bool supported();
  /// Changes the environment: call it before other threads run. Where there is no session bus, SDL would start one, and
  /// wait until every process that began meanwhile, such as a reader, has ended.
  static void need_no_bus();
  /// The first gamepad; at rest if there is none.
  [[nodiscard]] PadState pad();
  /// The SpaceMouse; at rest if there is none, or its daemon (spacenavd) does not run.
  [[nodiscard]] PuckState puck();

 private:
  struct Sdl;
  struct Spacenav;
  std::unique_ptr<Sdl> sdl_;
  std::unique_ptr<Spacenav> spacenav_;
};

}  // namespace roam::app
