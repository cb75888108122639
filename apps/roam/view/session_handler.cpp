#include "view/session_handler.h"

#include <utility>

#include "view/session.h"

namespace roam::app {

bool SessionHandler::handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& /*action*/) {
  if (event.getEventType() == osgGA::GUIEventAdapter::CLOSE_WINDOW) {
    session_.run(Command::quit);
    return false;
  }
  const bool down = event.getEventType() == osgGA::GUIEventAdapter::KEYDOWN;
  const bool up = event.getEventType() == osgGA::GUIEventAdapter::KEYUP;
  const int key = event.getUnmodifiedKey() != 0 ? event.getUnmodifiedKey() : event.getKey();
  if ((down || up) && !event.getHandled() && key == osgGA::GUIEventAdapter::KEY_Escape) return handle_escape(down);
  if (!down || event.getHandled() || session_.roamer_leads()) return false;
  const bool ctrl = (event.getModKeyMask() & osgGA::GUIEventAdapter::MODKEY_CTRL) != 0;
  const auto* command = session_.roamer().controls().lookup(key, ctrl);
  if (command == nullptr || parse_command(command->name) == Command::none) return false;
  session_.run(parse_command(command->name));
  return true;
}

bool SessionHandler::handle_escape(bool down) {
  // The settings may want it for something else.
  const auto* command = session_.roamer().controls().lookup(osgGA::GUIEventAdapter::KEY_Escape, false);
  if (command != nullptr && command->name != "release") return false;
  if (down) {
    // A key that stays down is pressed again and again.
    escape_spent_ |= session_.escape();
  } else if (!std::exchange(escape_spent_, false)) {
    session_.run(Command::quit);
  }
  return true;
}

}  // namespace roam::app
