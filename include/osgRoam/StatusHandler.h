#pragma once
/// \file
/// StatusHandler: a Manipulator's first use of keys, and its state on the picture, in other people's viewers.
///
///     osg::ref_ptr<osgRoam::Manipulator> roamer = new osgRoam::Manipulator(scene);
///     viewer.addEventHandler(new osgRoam::StatusHandler(roamer));  // before the other handlers
///     viewer.addEventHandler(new osgGA::StateSetManipulator(viewer.getCamera()->getOrCreateStateSet()));
///     viewer.addEventHandler(new osgViewer::StatsHandler);
///     viewer.setCameraManipulator(roamer);
///
/// While the manipulator is the camera of the view, alone or as the present one of a KeySwitchMatrixManipulator, the
/// keys of its commands are its own: W and S walk. Handlers that were added later receive all other keys. With another
/// camera this handler takes no key.
///
/// At the lower left of the window stands "walk, 1.4 m/s", the progress of buildSpace, or why the body is held. If it
/// is held for more than a second, osg::notify(NOTICE) says why, too, on the console.

#include <memory>
#include <osg/ref_ptr>
#include <osgGA/GUIEventHandler>
#include <string>

#include "osgRoam/Manipulator.h"

namespace osgRoam {

class StatusHandler : public osgGA::GUIEventHandler {
 public:
  explicit StatusHandler(osg::ref_ptr<Manipulator> roamer);

  void setShown(bool on);  ///< default true
  [[nodiscard]] bool shown() const;
  /// The line that was shown last; empty while another camera leads, or before the first frame.
  [[nodiscard]] const std::string& text() const;

  using osgGA::GUIEventHandler::handle;
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& viewer) override;

 protected:
  ~StatusHandler() override;

 private:
  struct State;
  const std::unique_ptr<State> _state;
};

}  // namespace osgRoam
