// A viewer of a paged OpenSceneGraph scene, with collision taken from the files that OpenSceneGraph's own pager reads.
// Files that are not read yet are solid. Fly with W, A, S, D and the arrow keys, look with the mouse, press G to walk
// and H for the other keys.
#include <osgRoam/Harvester.h>
#include <osgRoam/Manipulator.h>
#include <roam/patchwork.h>

#include <cstdio>
#include <memory>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgViewer/Viewer>

int main(int argc, char** argv) {
  osg::ArgumentParser arguments(&argc, argv);
  const auto space = std::make_shared<roam::Patchwork>();
  const osg::ref_ptr<osgRoam::Harvester> harvester = new osgRoam::Harvester(space);
  osgDB::Registry::instance()->setReadFileCallback(harvester);
  const osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFiles(arguments);
  if (!scene) {
    std::fprintf(stderr, "usage: osg_paged_scene ROOT...\n");
    return 2;
  }
  space->update();  // puts the root's coarsest level into use before there is a body
  harvester->setTakesUnnamedFiles(false);

  osgViewer::Viewer viewer(arguments);
  viewer.setSceneData(scene);
  scene->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);  // photographs have their own light
  const osg::ref_ptr<osgRoam::Manipulator> manipulator = new osgRoam::Manipulator;
  manipulator->setSpace(space);  // the manipulator updates the space before the steps of each frame
  viewer.setCameraManipulator(manipulator);
  const int status = viewer.run();

  viewer.getDatabasePager()->cancel();
  osgDB::Registry::instance()->setReadFileCallback(nullptr);
  const osgRoam::Harvester::Stats stats = harvester->getStats();
  std::printf("%llu files, %llu triangles were taken; %llu patches are in use\n",
              static_cast<unsigned long long>(stats.files), static_cast<unsigned long long>(stats.triangles),
              static_cast<unsigned long long>(space->stats().patches));
  return status;
}
