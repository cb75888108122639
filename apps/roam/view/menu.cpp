#include "view/menu.h"

#include <string>

#include "osgroam/pointer.h"
#include "view/session.h"

namespace roam::app {
namespace {

using Adapter = osgGA::GUIEventAdapter;

}  // namespace

bool Menu::handle(const Adapter& event, osgGA::GUIActionAdapter& /*action*/) {
  if (event.getHandled() || session_.roamer().mouseGrab()) return false;
  graphics::Hud& hud = session_.stage().hud();
  const std::string here = hud.help_at(event.getXnormalized(), event.getYnormalized());
  switch (event.getEventType()) {
    case Adapter::PUSH:
      return event.getButton() != 0 && push(event);
    case Adapter::RELEASE:
      if (!is_down_) return false;
      is_down_ = event.getButtonMask() != 0;
      return true;
    case Adapter::MOVE:
    case Adapter::DRAG:
      hud.set_help_focus(here);
      return hud.help_shown() || is_down_;
    case Adapter::SCROLL:
      if (const double notches = osgRoam::notches_of(event); notches > 0.0) {
        hud.turn_help(-1);
      } else if (notches < 0.0 && hud.help_goes_on()) {
        hud.turn_help(1);
      }
      return hud.help_shown() || is_down_;
    case Adapter::DOUBLECLICK:
      return hud.help_shown() || is_down_;
    default:
      return false;
  }
}

/// The menu acts when the button goes down, so that the release of a drag that began before does nothing.
bool Menu::push(const Adapter& event) {
  graphics::Hud& hud = session_.stage().hud();
  const double x = event.getXnormalized(), y = event.getYnormalized();
  const bool opens = hud.button_at(x, y);
  if (!hud.help_shown() && !opens) return false;
  const std::string command = hud.help_at(x, y);
  if (command == graphics::Hud::help_more) {
    hud.turn_help(1);
    return is_down_ = true;
  }
  hud.set_help_focus({});
  hud.show_help(opens);
  is_down_ = true;
  if (!command.empty() && command != "help") session_.press(command, is_shift_down(event));
  return true;
}

}  // namespace roam::app
