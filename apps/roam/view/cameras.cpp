#include "view/cameras.h"

#include <algorithm>
#include <osgGA/DriveManipulator>
#include <osgGA/FirstPersonManipulator>
#include <osgGA/FlightManipulator>
#include <osgGA/OrbitManipulator>
#include <osgGA/SphericalManipulator>
#include <osgGA/TerrainManipulator>
#include <osgGA/TrackballManipulator>

#include "view/body.h"
#include "view/commands.h"

namespace roam::app {
namespace {

constexpr int first_key = '1';

}  // namespace

Cameras::Cameras(Stage& stage, osgRoam::Manipulator& roamer) : stage_(stage), roamer_(roamer) {
  osgGA::CameraManipulator* const cameras[] = {
      &roamer,
      new osgGA::TrackballManipulator,
      new osgGA::FlightManipulator,
      new osgGA::DriveManipulator,
      new osgGA::TerrainManipulator,
      new osgGA::OrbitManipulator,
      new osgGA::FirstPersonManipulator,
      new osgGA::SphericalManipulator,
  };
  int key = first_key;
  for (osgGA::CameraManipulator* camera : cameras) {
    addMatrixManipulator(key, camera_names()[static_cast<std::size_t>(key - first_key)], camera);
    ++key;
  }
}

std::string Cameras::present() const {
  for (const auto& [key, named] : getKeyManipMap()) {
    if (named.second.get() == getCurrentMatrixManipulator()) return named.first;
  }
  return {};
}

void Cameras::select(std::size_t camera) {
  selectMatrixManipulator(static_cast<unsigned>(camera));
  // As its key does.
  osgViewer::Viewer& viewer = stage_.viewer();
  init(*viewer.getEventQueue()->getCurrentEventState(), viewer);
}

void Cameras::choose(const std::string& command) {
  if (!lead()) return;
  const std::vector<std::string>& names = camera_names();
  const auto now = static_cast<std::size_t>(std::find(names.begin(), names.end(), present()) - names.begin());
  select(command == body_camera ? 0 : now + 1 < names.size() ? now + 1 : 1);
}

void Cameras::return_to_body() {
  if (!lead() || body_leads()) return;
  const Pose stays = standing_pose_of(roamer_);
  select(0);
  go_to(roamer_, stays);
}

}  // namespace roam::app
