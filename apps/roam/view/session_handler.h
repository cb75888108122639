#pragma once
/// \file
/// The session's handler of window events.

#include <osgGA/GUIEventHandler>

#include "view/twice.h"

namespace roam::app {

class Session;

/// Runs the viewer's commands while another camera than the body's receives the keys, or none yet: once a press, as the
/// body's does. Handles Escape, which closes the help, releases the mouse, or, the second time within 3 s, ends the
/// session.
class SessionHandler : public osgGA::GUIEventHandler {
 public:
  explicit SessionHandler(Session& session) : session_(session) {}

  using osgGA::GUIEventHandler::handle;
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;

 private:
  bool step_out();
  bool handle_escape(bool down);
  void ask_to_end();

  static constexpr double leave_seconds = 3.0;

  Session& session_;
  int down_ = 0;               ///< the key that was pressed last, while it is down
  double down_at_ = 0.0;       ///< s: when it was pressed, or repeated, last
  bool escape_spent_ = false;  ///< Escape acted when pressed; its release does not end the session
  Twice leave_{leave_seconds};
};

}  // namespace roam::app
