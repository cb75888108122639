// An ordinary OpenSceneGraph viewer with one line replaced, so that the camera never crosses a wall. Fly with W, A, S,
// D and the arrow keys, look with the mouse, press G to walk and H for the other keys.
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
