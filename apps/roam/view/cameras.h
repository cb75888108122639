#pragma once
/// \file
/// The cameras on the keys 1, 2, 3, ...

#include <osgGA/KeySwitchMatrixManipulator>
#include <string>

#include "osgRoam/Manipulator.h"
#include "view/stage.h"

namespace roam::app {

/// Switches between the body's camera and those of osgviewer; see camera_names().
///
/// OpenSceneGraph's class places the camera itself and never calls updateCamera() of the active manipulator.
/// osgRoam::Manipulator needs that call: it picks clicked points in its camera's picture.
class Cameras : public osgGA::KeySwitchMatrixManipulator {
 public:
  Cameras(Stage& stage, osgRoam::Manipulator& roamer);

  void updateCamera(osg::Camera& camera) override {
    if (osgGA::CameraManipulator* leading = getCurrentMatrixManipulator()) leading->updateCamera(camera);
  }
  /// Whether they lead the viewer.
  [[nodiscard]] bool lead() const { return stage_.viewer().getCameraManipulator() == this; }
  /// Whether the body's camera receives the keys.
  [[nodiscard]] bool body_leads() const { return lead() && getCurrentMatrixManipulator() == &roamer_; }
  /// The name of the camera that receives the keys.
  [[nodiscard]] std::string present() const;
  /// Does what the key of the body's camera does, or of the next one of the others in a circle, if they lead.
  void choose(const std::string& command);
  /// The body's camera leads from now on. The body stays, which its key would place where the other camera was.
  void return_to_body();

 protected:
  ~Cameras() override = default;

 private:
  void select(std::size_t camera);

  Stage& stage_;
  osgRoam::Manipulator& roamer_;
};

}  // namespace roam::app
