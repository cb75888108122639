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
  int key = '1';
  for (osgGA::CameraManipulator* camera : cameras) {
    addMatrixManipulator(key, camera_names()[static_cast<std::size_t>(key - '1')], camera);
    ++key;
  }
}

std::string Cameras::present() const {
  for (const auto& [key, named] : getKeyManipMap()) {
    if (named.second.get() == getCurrentMatrixManipulator()) return named.first;
  }
  return {};
}

}  // namespace roam::app
