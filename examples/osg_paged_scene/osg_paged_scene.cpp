// A viewer of a paged OpenSceneGraph scene. Collision comes from the files as OpenSceneGraph's own pager reads them:
// what it has not read yet is solid. W, A, S, D and the arrows fly, the mouse looks, G walks, H tells of the other
// keys.
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
  space->update();  // now the root's coarsest level is there, before there is a body
  harvester->setTakesUnnamedFiles(false);

  osgViewer::Viewer viewer(arguments);
  viewer.setSceneData(scene);
  scene->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);  // photographs have their own light
  const osg::ref_ptr<osgRoam::Manipulator> manipulator = new osgRoam::Manipulator;
  manipulator->setSpace(space);  // which is updated before the steps of each frame
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
