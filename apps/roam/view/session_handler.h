#pragma once
/// \file
/// What a session sees of the viewer's events beside its manipulators.

#include <osgGA/GUIEventHandler>

namespace roam::app {

class Session;

/// Runs the viewer's commands while another camera than the body's has the keys, or none has yet; and sees to Escape,
/// which closes the help, gives the mouse back, or ends.
class SessionHandler : public osgGA::GUIEventHandler {
 public:
  explicit SessionHandler(Session& session) : session_(session) {}

  using osgGA::GUIEventHandler::handle;
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;

 private:
  bool step_out();
  bool handle_escape(bool down);

  Session& session_;
  bool escape_spent_ = false;  ///< it has done something when it went down: that it goes up ends nothing
};

}  // namespace roam::app
