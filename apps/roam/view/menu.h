#pragma once
/// \file
/// The help as a menu for the mouse.

#include <osgGA/GUIEventHandler>
#include <string>

#include "osgRoam/Manipulator.h"
#include "view/cameras.h"
#include "view/stage.h"

namespace roam::app {

/// A button opens the help. A click on a line of the help closes it and presses the line's key, a click elsewhere only
/// closes it. While the help is open, the mouse does nothing else, unless it is grabbed.
///
/// Call all members from the thread that draws, between two frames.
class Menu : public osgGA::GUIEventHandler {
 public:
  Menu(Stage& stage, const osgRoam::Manipulator& roamer, const Cameras& cameras)
      : stage_(stage), roamer_(roamer), cameras_(cameras) {}

  using osgGA::GUIEventHandler::handle;
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;

 protected:
  ~Menu() override = default;

 private:
  bool push(const osgGA::GUIEventAdapter& event);

  Stage& stage_;
  const osgRoam::Manipulator& roamer_;
  const Cameras& cameras_;
  bool is_down_ = false;  ///< a button of the mouse was pressed here
};

}  // namespace roam::app
