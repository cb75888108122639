#include "view/cameras.h"

#include <osgGA/DriveManipulator>
#include <osgGA/FirstPersonManipulator>
#include <osgGA/FlightManipulator>
#include <osgGA/OrbitManipulator>
#include <osgGA/SphericalManipulator>
#include <osgGA/TerrainManipulator>
#include <osgGA/TrackballManipulator>

#include "view/commands.h"

namespace roam::app {
namespace {

constexpr int first_key = '1';

}  // namespace

Cameras::Cameras(osgRoam::Manipulator& roamer) {
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

int Cameras::key_for(const std::string& command) const {
  if (command == body_camera) return first_key;
  const int last = first_key + static_cast<int>(camera_names().size()) - 1;
  for (int key = first_key; key < last; ++key) {
    if (camera_names()[static_cast<std::size_t>(key - first_key)] == present()) return key + 1;
  }
  return first_key + 1;
}

}  // namespace roam::app
