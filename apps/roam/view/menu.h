#pragma once
/// \file
/// The help as a menu for the mouse.

#include <osgGA/GUIEventHandler>

namespace roam::app {

class Session;

/// A button opens the help. A click on a line of the help closes it and does what the line's key does, a click
/// elsewhere only closes it. While the help is open, the mouse does nothing else, unless it is grabbed.
///
/// Call all members from the thread that draws, between two frames.
class Menu : public osgGA::GUIEventHandler {
 public:
  explicit Menu(Session& session) : session_(session) {}

  using osgGA::GUIEventHandler::handle;
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;

 protected:
  ~Menu() override = default;

 private:
  bool push(const osgGA::GUIEventAdapter& event);

  Session& session_;
  bool is_down_ = false;  ///< a button of the mouse was pressed here
};

}  // namespace roam::app
