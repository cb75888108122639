#include "view/session_handler.h"

#include <utility>

#include "view/session.h"

namespace roam::app {

bool SessionHandler::handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& /*action*/) {
  if (event.getEventType() == osgGA::GUIEventAdapter::CLOSE_WINDOW) {
    session_.run("quit");
    return false;
  }
  const bool down = event.getEventType() == osgGA::GUIEventAdapter::KEYDOWN;
  const bool up = event.getEventType() == osgGA::GUIEventAdapter::KEYUP;
  const int key = event.getUnmodifiedKey() != 0 ? event.getUnmodifiedKey() : event.getKey();
  // A held key repeats. A release may be lost, but a repeat comes soon.
  constexpr double longest_pause = 1.0;  // s
  const bool fresh = down && (key != down_ || event.getTime() - down_at_ > longest_pause);
  if (down) {
    down_ = key;
    down_at_ = event.getTime();
  } else if (up && key == down_) {
    down_ = 0;
  }
  if ((down || up) && !event.getHandled() && key == osgGA::GUIEventAdapter::KEY_Escape) return handle_escape(down);
  if (!fresh || event.getHandled() || session_.roamer_leads()) return false;
  const bool ctrl = (event.getModKeyMask() & osgGA::GUIEventAdapter::MODKEY_CTRL) != 0;
  const auto* command = session_.roamer().controls().lookup(key, ctrl);
  return command != nullptr && session_.run(command->name, is_shift_down(event));
}

/// Closes the help, else releases the mouse, else closes the list. False if there is none of these.
bool SessionHandler::step_out() {
  graphics::Hud& hud = session_.stage().hud();
  osgRoam::Manipulator& roamer = session_.roamer();
  ListPanel* const list = session_.shown_list();
  if (!hud.help_shown() && !roamer.mouseGrab() && list == nullptr) return false;
  if (hud.help_shown()) {
    hud.show_help(false);
  } else if (roamer.mouseGrab()) {
    roamer.setMouseGrab(false);
  } else {
    list->close();
  }
  return true;
}

bool SessionHandler::handle_escape(bool down) {
  // The settings may give Escape to another command.
  const auto* command = session_.roamer().controls().lookup(osgGA::GUIEventAdapter::KEY_Escape, false);
  if (command != nullptr && command->name != "release") return false;
  if (down) {
    // A held key repeats.
    escape_spent_ |= step_out();
  } else if (!std::exchange(escape_spent_, false)) {
    ask_to_end();
  }
  return true;
}

void SessionHandler::ask_to_end() {
  Stage& stage = session_.stage();
  if (leave_.confirms(stage.now())) {
    session_.run("quit");
  } else {
    stage.hint("Escape again ends", leave_seconds);
  }
}

}  // namespace roam::app
