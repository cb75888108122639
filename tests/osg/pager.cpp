// Bodies that fly fast through a paged scene while OpenSceneGraph's own pager reads it, drops it and reads it again.

#include <gtest/gtest.h>

#include <chrono>
#include <glm/geometric.hpp>
#include <memory>
#include <osg/PagedLOD>
#include <osgDB/DatabasePager>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <thread>

#include "clutter.h"
#include "import_files.h"
#include "osgRoam/Harvester.h"
#include "roam/walker.h"
#include "walker_scenes.h"

namespace {

using osgRoam::Harvester;
using roam::Vec3;

/// Asks the pager for what a cull visitor would: the finest level of what is near, in a scene that nobody draws.
class Near : public osg::NodeVisitor {
 public:
  Near(osgDB::DatabasePager& pager, osg::FrameStamp& stamp) : osg::NodeVisitor(CULL_VISITOR, TRAVERSE_ACTIVE_CHILDREN) {
    setDatabaseRequestHandler(&pager);
    setFrameStamp(&stamp);
  }

  void apply(osg::PagedLOD& lod) override {
    const double away = (osg::Vec3d(lod.getCenter()) - eye).length();
    if (away < lod.getRadius() + reach) {
      traverse(lod);
    } else if (lod.getNumChildren() > 0) {
      lod.getChild(0)->accept(*this);
    }
  }

  osg::Vec3d eye;
  double reach = 60.0;
};

/// A slow disk.
class Slow : public osgDB::ReadFileCallback {
 public:
  osgDB::ReaderWriter::ReadResult readNode(const std::string& file, const osgDB::Options* options) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return osgDB::ReadFileCallback::readNode(file, options);
  }
};

/// A scene, its pager, and the frames of a viewer.
class Paged {
 public:
  Paged(const std::string& file, Harvester* harvester) {
    osgDB::Registry::instance()->setReadFileCallback(harvester);
    pager->setDoPreCompile(false);
    pager->setTargetMaximumNumberOfPageLOD(10);
    root->addChild(osgDB::readRefNodeFile(file));
    pager->registerPagedLODs(root);
  }
  ~Paged() {
    pager->cancel();
    osgDB::Registry::instance()->setReadFileCallback(nullptr);
  }
  Paged(const Paged&) = delete;
  Paged& operator=(const Paged&) = delete;

  void frame(const Vec3& eye) {
    stamp->setFrameNumber(stamp->getFrameNumber() + 1);
    stamp->setReferenceTime(stamp->getReferenceTime() + 1.0 / 60.0);
    pager->signalBeginFrame(stamp);
    near.eye.set(eye.x, eye.y, eye.z);
    root->accept(near);
    pager->updateSceneGraph(*stamp);
    pager->signalEndFrame();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // it is the pager's turn
  }

  osg::ref_ptr<osgDB::DatabasePager> pager = osgDB::DatabasePager::create();
  osg::ref_ptr<osg::FrameStamp> stamp = new osg::FrameStamp;
  osg::ref_ptr<osg::Group> root = new osg::Group;
  Near near{*pager, *stamp};
};

std::string pit() { return (roam::test::test_data() / "pit_osgb/Data/Tile_+000_+000/Tile_+000_+000.osgb").string(); }

/// All triangles of the finest level, read by roam's own reader.
roam::Mesh finest_of_pit() {
  roam::Mesh all;
  for (const roam::Mesh& mesh : roam::import_scene(roam::test::test_data() / "pit_osgb").meshes) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (auto t : mesh.triangles) {
      for (auto& corner : t) corner += first;
      all.triangles.push_back(t);
    }
  }
  return all;
}

TEST(OsgPager, LetsNobodyThroughTheFinestLevelAtFiftyMetresASecond) {
  ROAM_NEEDS_TEST_DATA();
  const roam::Mesh finest = finest_of_pit();
  ASSERT_EQ(finest.triangles.size(), 177950u);
  const scenes::Judge judge(finest);
  const auto space = std::make_shared<roam::Patchwork>();
  const osg::ref_ptr<Harvester> harvester = new Harvester(space, Harvester::FINEST_ONLY);
  harvester->setNextCallback(new Slow);
  Paged scene(pit(), harvester);
  scene.near.reach = 30.0;
  space->update();
  const roam::WalkerSettings ball{.radius = 0.5, .height = 1.0, .eye = 0.5};
  roam::Walker walker(*space, ball, roam::Mode::fly, {160.0, 120.0, 400.0});
  clutter::Random random(5);
  Vec3 aim(160.0, 120.0, 40.0);
  int met_unknown = 0, met_ground = 0;
  double flown = 0.0;
  bool held = false;
  for (int i = 0; i < 1500; ++i) {
    if (i % 60 == 59) aim = {random.between(20.0, 300.0), random.between(20.0, 220.0), random.between(-5.0, 60.0)};
    const Vec3 way = aim - walker.position();
    // At first nobody asks for pages; later a body that is held waits a little for them.
    for (int f = 0; i >= 120 && f < (held ? 20 : 1); ++f) scene.frame(walker.position());
    space->update(walker.body(), walker.position());
    const Vec3 before = walker.position();
    const roam::StepReport& step = walker.step({.velocity = 50.0 * way / (1e-9 + glm::length(way))}, 1.0 / 60.0);
    ASSERT_GE(scenes::margin(judge, step, ball.radius), 0.0) << "step " << i;
    flown += glm::length(walker.position() - before);
    const roam::Clearance beside = space->clearance(walker.body(), walker.position(), 0.05);
    held = beside.found && beside.unknown;
    met_unknown += held ? 1 : 0;
    met_ground += beside.found && !beside.unknown ? 1 : 0;
  }
  EXPECT_GT(flown, 400.0);
  EXPECT_GT(met_ground, 20);
  EXPECT_GT(met_unknown, 10);
  EXPECT_EQ(harvester->getStats().failed, 0u);
  std::cout << "flown " << flown << " m; beside ground in " << met_ground << ", beside what is unknown in "
            << met_unknown << " of 1500 steps; " << harvester->getStats().files << " files\n";
}

TEST(OsgPager, BringsTheFinestLevelInTheEnd) {
  ROAM_NEEDS_TEST_DATA();
  const roam::Mesh finest = finest_of_pit();
  const auto space = std::make_shared<roam::Patchwork>();
  const osg::ref_ptr<Harvester> harvester = new Harvester(space);
  Paged scene(pit(), harvester);
  scene.near.reach = 1e6;
  const roam::Body body{0.5};
  const Vec3 aside(0.0, 0.0, 1e5);
  space->update(body, aside);
  EXPECT_GT(space->stats().triangles, 0u) << "coarse ones first";
  EXPECT_LT(space->stats().triangles, 100000u);
  for (int i = 0; i < 20000 && (i == 0 || harvester->getStats().expected > 0); ++i) scene.frame({160.0, 120.0, 100.0});
  space->update(body, aside);
  EXPECT_EQ(harvester->getStats().expected, 0u);
  EXPECT_EQ(space->stats().triangles, finest.triangles.size());
  EXPECT_EQ(space->stats().unknown, 0u);
  const roam::World world = roam::World::build({&finest, 1});
  clutter::Random random(6);
  int hits = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 from(random.between(0.0, 324.0), random.between(0.0, 242.0), random.between(0.0, 80.0));
    const Vec3 motion = random.in_box(40.0);
    const roam::Impact a = space->sweep(body, from, motion), b = world.sweep(body, from, motion);
    const double length = glm::length(motion);
    hits += a.hit ? 1 : 0;
    ASSERT_NEAR((a.hit ? a.time : 1.0) * length, (b.hit ? b.time : 1.0) * length, 0.1) << i;  // grazes stop early
  }
  EXPECT_GT(hits, 500);
}

}  // namespace
