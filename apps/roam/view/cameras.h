#pragma once
/// \file
/// The cameras on the keys 1, 2, 3, ...

#include <osgGA/KeySwitchMatrixManipulator>
#include <string>

#include "osgRoam/Manipulator.h"

namespace roam::app {

/// Switches between the body's camera and those of osgviewer, see camera_names().
///
/// OpenSceneGraph's class places the camera itself and never calls the manipulator that leads. But
/// osgRoam::Manipulator must know the picture that its camera makes, for what is clicked.
class Cameras : public osgGA::KeySwitchMatrixManipulator {
 public:
  explicit Cameras(osgRoam::Manipulator& roamer);

  void updateCamera(osg::Camera& camera) override {
    if (osgGA::CameraManipulator* leading = getCurrentMatrixManipulator()) leading->updateCamera(camera);
  }
  /// Whether this one has the keys.
  [[nodiscard]] bool leads(const osgGA::CameraManipulator& camera) const {
    return getCurrentMatrixManipulator() == &camera;
  }
  /// The name of the one that does.
  [[nodiscard]] std::string present() const;

 protected:
  ~Cameras() override = default;
};

}  // namespace roam::app
