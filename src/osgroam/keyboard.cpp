#include "osgroam/keyboard.h"

#include <osgGA/GUIEventAdapter>
#include <utility>

namespace osgRoam {

bool Keyboard::press(const Controls& controls, int symbol, double time) {
  if (!down_.insert(symbol).second) return false;
  note(controls, time);
  return true;
}

void Keyboard::release(const Controls& controls, int symbol, double time) {
  if (down_.erase(symbol) > 0) note(controls, time);
}

void Keyboard::release_all(double time) {
  if (down_.empty()) return;
  down_.clear();
  held_ = {};
  changes_.push_back({time, held_, false});
}

void Keyboard::ask_to_jump(double time) { changes_.push_back({time, held_, true}); }

bool Keyboard::ctrl() const { return is_down(osgGA::GUIEventAdapter::KEY_Control_L); }

bool Keyboard::is_down(const Controls& controls, std::string_view command) const {
  for (const int symbol : down_) {
    const Controls::Command* called = controls.lookup(symbol, ctrl());
    if (called && called->name == command) return true;
  }
  return false;
}

void Keyboard::note(const Controls& controls, double time) {
  const auto down = [&](std::string_view command) { return is_down(controls, command); };
  held_ = {down("forward"), down("back"), down("left"), down("right"), down("up"),
           down("down"),    down("fast"), down("slow"), down("crouch")};
  changes_.push_back({time, held_, false});
}

std::vector<Keyboard::Change> Keyboard::take_changes() { return std::exchange(changes_, {}); }

}  // namespace osgRoam
