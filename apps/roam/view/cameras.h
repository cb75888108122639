#pragma once
/// \file
/// The cameras on the keys 1, 2, 3, ...

#include <osgGA/KeySwitchMatrixManipulator>
#include <string>

#include "osgRoam/Manipulator.h"

namespace roam::app {

/// Switches between the body's camera and those of osgviewer; see camera_names().
///
/// OpenSceneGraph's class places the camera itself and never calls updateCamera() of the active manipulator.
/// osgRoam::Manipulator needs that call: it picks clicked points in its camera's picture.
class Cameras : public osgGA::KeySwitchMatrixManipulator {
 public:
  explicit Cameras(osgRoam::Manipulator& roamer);

  void updateCamera(osg::Camera& camera) override {
    if (osgGA::CameraManipulator* leading = getCurrentMatrixManipulator()) leading->updateCamera(camera);
  }
  /// Whether this camera receives the keys.
  [[nodiscard]] bool leads(const osgGA::CameraManipulator& camera) const {
    return getCurrentMatrixManipulator() == &camera;
  }
  /// The name of the camera that receives the keys.
  [[nodiscard]] std::string present() const;
  /// The key of the body's camera, or of the next one of the others in a circle.
  [[nodiscard]] int key_for(const std::string& command) const;

 protected:
  ~Cameras() override = default;
};

}  // namespace roam::app
