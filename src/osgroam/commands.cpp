// The commands of the manipulator, their keys, and what they do.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "osgroam/manipulator_state.h"

namespace osgRoam {
namespace {

using Adapter = osgGA::GUIEventAdapter;

/// Factor of the speed for one notch of the wheel; three notches double it.
constexpr double notch = 1.25;

/// Seconds between two notches of a wheel that is turned fast, and the least share of a notch that comes sooner.
constexpr double notch_time = 0.04, least_share = 0.05;

/// Metres: the limit of a click's distance.
constexpr double click_limit = 1e5;

/// Radians for a mouse movement over the height of the window: a quarter turn.
constexpr double default_look_speed = 0.5 * std::numbers::pi;

int symbol(const Adapter& event) {
  const int unmodified = event.getUnmodifiedKey();
  return Controls::canonical(unmodified > 0 ? unmodified : event.getKey());
}

/// Meta, Alt, Super and Hyper, with which people leave a window. The window manager may keep the release events of keys
/// then.
bool leaves_window(int key) { return key >= Adapter::KEY_Meta_L && key <= Adapter::KEY_Hyper_R; }

}  // namespace

Manipulator::State::State() : look_speed(default_look_speed) {
  pose.yaw = 0.5 * std::numbers::pi;  // along +y, like every manipulator of osgGA
  using enum Controls::Kind;
  keys.add("forward", "W, Up", "walks or flies forward", held);
  keys.add("back", "S, Down", "goes back", held);
  keys.add("left", "A, Left", "goes to the left", held);
  keys.add("right", "D, Right", "goes to the right", held);
  keys.add("up", "E, Page_Up", "rises (flying)", held);
  keys.add("down", "Q, Page_Down", "sinks (flying)", held);
  keys.add("fast", "Shift", "hurries", held);
  keys.add("slow", "Ctrl", "goes slowly", held);
  keys.add("jump", "Space", "jumps (walking)", pressed);
  keys.add("crouch", "C", "crouches (walking)", held);
  keys.add("gravity", "G", "changes between walking and flying", pressed);
  keys.add("ghost", "N", "turns passing through walls on and off", pressed);
  keys.add("home", "Home", "goes back to the start", pressed);
  keys.add("grab", "M", "lets the mouse look without a button", pressed);
  keys.add("release", "Escape", "lets go of the mouse", pressed);
  keys.add("look", "Drag", "looks around", gesture);
  keys.add("speed", "Wheel", "changes the speed", gesture);
  keys.add("go", "Double click", "goes to the clicked place", gesture);
}

bool Manipulator::State::key_down(const Adapter& event) {
  const int key = symbol(event);
  if (leaves_window(key)) {
    keyboard.release_all(event.getTime());
    pointer.want_grab(false);
    return false;
  }
  const bool fresh = keyboard.press(keys, key, event.getTime());
  const Controls::Command* command = keys.lookup(key, keyboard.ctrl());
  if (!command) return false;
  if (command->kind != Controls::Kind::pressed) return true;
  if (!fresh || press(*command, event.getTime())) return true;
  // StatusHandler and the viewer may both pass the event on. The second time it is refused, too.
  keyboard.release(keys, key, event.getTime());
  return false;
}

void Manipulator::State::key_up(const Adapter& event) { keyboard.release(keys, symbol(event), event.getTime()); }

bool Manipulator::State::press(const Controls::Command& command, double time) {
  const std::string name = command.name;
  if (name == "jump") {
    keyboard.ask_to_jump(time);
  } else if (name == "gravity") {
    change_mode(mode == roam::Mode::walk ? roam::Mode::fly : roam::Mode::walk);
  } else if (name == "ghost") {
    change_mode(mode == roam::Mode::ghost ? before_ghost : roam::Mode::ghost);
  } else if (name == "home") {
    home_wanted = true;
  } else if (name == "grab") {
    pointer.want_grab(!pointer.grab_wanted());
  } else if (name == "release") {
    if (!pointer.grab_wanted()) return false;
    pointer.want_grab(false);
  } else if (on_command) {
    guarded([&] { call(on_command, name); });
  } else {
    return false;
  }
  return true;
}

bool Manipulator::State::look(const Adapter& event) {
  const Pointer::Movement movement = pointer.move(event);
  if (movement.left == 0.0 && movement.up == 0.0) return false;
  pose.yaw = wrapped_yaw(pose.yaw + movement.left * look_speed);
  pose.pitch = limited_pitch(pose.pitch + (look_inverted ? -1.0 : 1.0) * movement.up * look_speed);
  return true;
}

bool Manipulator::State::scroll(const Adapter& event) {
  const double notches = notches_of(event);
  if (notches == 0.0) return false;
  // Two fingers on a touchpad give many more notches a second than a wheel. They count as a fast wheel's.
  const double since = event.getTime() - std::exchange(scrolled_at, event.getTime());
  const double share = since >= 0.0 ? std::clamp(since / notch_time, least_share, 1.0) : 1.0;
  change_speed(settings.speed * std::pow(notch, share * notches));
  return true;
}

bool Manipulator::State::go_to_clicked(const Adapter& event) {
  if (!projection || !can_go()) return false;
  const bool grabbed = pointer.grab_wanted();  // then the pointer stands for the middle of the picture
  const double x = grabbed ? 0.0 : event.getXnormalized(), y = grabbed ? 0.0 : event.getYnormalized();
  const roam::Vec3 from = eye();
  const std::optional<roam::Vec3> direction = through_picture({from, pose.yaw, pose.pitch}, *projection, x, y);
  if (!direction || !std::isfinite(glm::length(*direction))) return false;
  roam::Impact seen;
  guarded([&] {
    const roam::Box bounds = space->bounds();
    const double farthest = bounds.empty() ? 0.0 : glm::length(bounds.center() - from) + glm::length(bounds.size());
    seen = space->ray(from, std::min(farthest, click_limit) * *direction);
  });
  if (!seen.hit || seen.unknown) return false;
  go(seen.point, seen.normal);
  return true;
}

}  // namespace osgRoam
