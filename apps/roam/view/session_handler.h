#pragma once
/// \file
/// The session's handler of window events.

#include <osgGA/GUIEventHandler>

namespace roam::app {

class Session;

/// Runs the viewer's commands while another camera than the body's receives the keys, or none yet. Handles Escape,
/// which closes the help, releases the mouse, or ends the session.
class SessionHandler : public osgGA::GUIEventHandler {
 public:
  explicit SessionHandler(Session& session) : session_(session) {}

  using osgGA::GUIEventHandler::handle;
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;

 private:
  bool step_out();
  bool handle_escape(bool down);

  Session& session_;
  bool escape_spent_ = false;  ///< Escape acted when pressed; its release does not end the session
};

}  // namespace roam::app
