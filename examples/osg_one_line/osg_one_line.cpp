// An ordinary viewer of OpenSceneGraph in which one line was replaced. W, A, S, D and the arrows fly, the mouse looks,
// G walks, H tells of the other keys; no wall is ever crossed.
#include <osgRoam/Manipulator.h>

#include <cstdio>
#include <osgDB/ReadFile>
#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

int main(int argc, char** argv) {
  osg::ArgumentParser arguments(&argc, argv);
  osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFiles(arguments);
  if (!scene) {
    std::fprintf(stderr, "usage: osg_one_line SCENE...\n");
    return 2;
  }
  osgViewer::Viewer viewer(arguments);
  viewer.setSceneData(scene);
  viewer.addEventHandler(new osgViewer::HelpHandler(arguments.getApplicationUsage()));

  // Before: viewer.setCameraManipulator(new osgGA::TrackballManipulator);
  viewer.setCameraManipulator(new osgRoam::Manipulator(scene));

  const int status = viewer.run();
  const osg::Vec3d eye = viewer.getCamera()->getInverseViewMatrix().getTrans();
  std::printf("the camera was last at %.2f %.2f %.2f\n", eye.x(), eye.y(), eye.z());
  return status;
}
