#include "view/gamepad.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace roam::app {
namespace {

using Axes = osgRoam::Manipulator::Axes;

// Radians a second at full deflection.
const double turn_rate = glm::radians(150.0), look_rate = glm::radians(100.0);

/// A stick without its dead zone, which is round. Small deflections are slower, for fine movements.
std::array<double, 2> live(const std::array<double, 2>& stick) {
  const double length = std::min(1.0, std::hypot(stick[0], stick[1]));
  if (!(length > dead_zone)) return {};
  const double share = (length - dead_zone) / (1.0 - dead_zone);
  const double factor = share * share / std::hypot(stick[0], stick[1]);
  return {stick[0] * factor, stick[1] * factor};
}

double live(double axis) {
  const double size = std::min(1.0, std::abs(axis));
  return size > dead_zone ? std::copysign((size - dead_zone) / (1.0 - dead_zone), axis) : 0.0;
}

constexpr std::pair<const char*, const char*> gamepad_parts[] = {
    {"Sticks", "left: walk, right: look"},    {"Triggers", "sink, rise (flying)"},
    {"Shoulders", "hurry, go slowly"},        {"A, B", "jump, crouch"},
    {"X, Y", "walk or fly, accept an offer"}, {"Back, Start", "plan, menu"},
};

}  // namespace

Axes axes_of(const PadState& pad, double sensitivity, bool inverted) {
  const std::array<double, 2> walk = live(pad.left), look = live(pad.right);
  Axes axes;
  axes.right = walk[0];
  axes.forward = -walk[1];
  axes.up = live(pad.right_trigger) - live(pad.left_trigger);
  axes.turn_left = -look[0] * turn_rate * sensitivity;
  axes.look_up = (inverted ? 1.0 : -1.0) * look[1] * look_rate * sensitivity;
  axes.fast = pad.is_down(PadButton::left_shoulder);
  axes.slow = pad.is_down(PadButton::right_shoulder);
  axes.crouch = pad.is_down(PadButton::b);
  return axes;
}

Axes axes_of(const PuckState& puck, double sensitivity) {
  Axes axes;
  axes.right = live(puck.right);
  axes.forward = live(puck.forward);
  axes.up = live(puck.up);
  axes.turn_left = live(puck.turn_left) * turn_rate * sensitivity;
  axes.look_up = live(puck.look_up) * look_rate * sensitivity;
  return axes;
}

Axes sum_of(const Axes& a, const Axes& b) {
  return {a.forward + b.forward, a.right + b.right, a.up + b.up,      a.turn_left + b.turn_left,
          a.look_up + b.look_up, a.fast || b.fast,  a.slow || b.slow, a.crouch || b.crouch};
}

const char* command_of(PadButton button) {
  switch (button) {
    case PadButton::a:
      return "jump";
    case PadButton::x:
      return "gravity";
    case PadButton::y:
      return "adapt";
    case PadButton::back:
      return "plan";
    case PadButton::start:
      return "help";
    case PadButton::left_stick:
      return "home";
    case PadButton::right_stick:
      return "next_bookmark";
    default:
      return nullptr;
  }
}

std::span<const std::pair<const char*, const char*>> gamepad_help() { return gamepad_parts; }

}  // namespace roam::app
