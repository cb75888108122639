#pragma once
/// \file
/// What a session sees of the viewer's events beside its manipulators.

#include <osgGA/GUIEventHandler>

namespace roam::app {

class Session;

/// Runs the viewer's commands while another camera than the body's has the keys, or none has yet.
class SessionHandler : public osgGA::GUIEventHandler {
 public:
  explicit SessionHandler(Session& session) : session_(session) {}

  using osgGA::GUIEventHandler::handle;
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;

 private:
  Session& session_;
};

}  // namespace roam::app
