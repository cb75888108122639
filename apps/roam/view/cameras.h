#pragma once
/// \file
/// The cameras on the keys 1, 2, 3, ...

#include <osgGA/KeySwitchMatrixManipulator>

namespace roam::app {

/// Of OpenSceneGraph's, which places the camera itself and never asks the one that leads: a manipulator that wants to
/// know the picture that its camera makes, as osgRoam::Manipulator does of what is clicked, would never learn of it.
class Cameras : public osgGA::KeySwitchMatrixManipulator {
 public:
  void updateCamera(osg::Camera& camera) override {
    if (osgGA::CameraManipulator* leading = getCurrentMatrixManipulator()) leading->updateCamera(camera);
  }

 protected:
  ~Cameras() override = default;
};

}  // namespace roam::app
