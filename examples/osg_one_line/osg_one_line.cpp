// An ordinary OpenSceneGraph viewer with one line replaced, so that the camera never crosses a wall. Fly with W, A, S,
// D and the arrow keys, look with the mouse, press G to walk. H shows the other keys, because of HelpHandler.
#include <osgRoam/Manipulator.h>
#include <osgRoam/StatusHandler.h>

#include <cstdio>
#include <osgDB/ReadFile>
#include <osgGA/StateSetManipulator>
#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

int main(int argc, char** argv) {
  osg::ArgumentParser arguments(&argc, argv);
  osgViewer::Viewer viewer(arguments);  // takes its options, such as --window, before files are read
  osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFiles(arguments);
  if (!scene) {
    std::fprintf(stderr, "usage: osg_one_line SCENE...\n");
    return 2;
  }
  viewer.setSceneData(scene);

  // Before: viewer.setCameraManipulator(new osgGA::TrackballManipulator);
  osg::ref_ptr<osgRoam::Manipulator> roamer = new osgRoam::Manipulator(scene);
  viewer.setCameraManipulator(roamer);

  // Shows what the body does, and keeps W and S for it, which the handlers below would take.
  viewer.addEventHandler(new osgRoam::StatusHandler(roamer));
  viewer.addEventHandler(new osgGA::StateSetManipulator(viewer.getCamera()->getOrCreateStateSet()));
  viewer.addEventHandler(new osgViewer::StatsHandler);
  viewer.addEventHandler(new osgViewer::HelpHandler(arguments.getApplicationUsage()));

  const int status = viewer.run();
  const osg::Vec3d eye = viewer.getCamera()->getInverseViewMatrix().getTrans();
  std::printf("the camera was last at %.2f %.2f %.2f\n", eye.x(), eye.y(), eye.z());
  return status;
}
