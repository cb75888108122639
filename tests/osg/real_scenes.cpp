// The intersector in scenes of other people, beside the world that roam's own reader brings.

#include <gtest/gtest.h>

#include <map>
#include <osg/KdTree>
#include <osgDB/ReadFile>
#include <string>

#include "clutter.h"
#include "import_files.h"
#include "osgRoam/BoxIntersector.h"
#include "osgRoam/Triangles.h"
#include "roam/world.h"

namespace {

using roam::Body;
using roam::Vec3;

/// What a lossless world may be off by, and floats of a reader by which transforms are multiplied in another order.
constexpr double tolerance = 5e-5;

roam::World lossless_world(const std::string& file) {
  roam::BuildOptions options;
  options.lossless = true;
  return roam::World::build(roam::import_scene(roam::test::test_data() / file).meshes, options);
}

/// Random ways through the world's box, of bodies that OpenSceneGraph's own visitor leads through the graph.
void compare(osg::Node& scene, const roam::World& world, int queries) {
  clutter::Random random(21);
  const roam::Box box = world.bounds();
  const double margin = osgRoam::boundsMargin(scene);
  int hits = 0;
  for (int i = 0; i < queries; ++i) {
    const Body body{random.between(0.1, 0.8), i % 2 == 0 ? 0.0 : 0.6};
    Vec3 from;
    for (int k = 0; k < 3; ++k) from[k] = random.between(box.lower[k], box.upper[k]);
    const Vec3 motion = random.in_box(8.0), to = from + motion;
    osg::ref_ptr<osgRoam::BoxIntersector> asked =
        new osgRoam::BoxIntersector(body, {from.x, from.y, from.z}, {to.x, to.y, to.z});
    asked->setBoundsMargin(margin);
    osgUtil::IntersectionVisitor visitor(asked);
    scene.accept(visitor);
    const bool hit = asked->containsIntersections();
    const double time = hit ? asked->getFirstIntersection().time : 1.0;
    hits += hit ? 1 : 0;
    const Vec3 way = time * motion;
    if (time > 0.0) {
      ASSERT_GE(world.clearance(body, from, way, 1.0).distance, -tolerance) << "late, query " << i;
    }
    if (hit) {
      ASSERT_LE(world.clearance(body, from + way, 1.0).distance, tolerance) << "early, query " << i;
    }
  }
  EXPECT_GT(hits, queries / 50);
  EXPECT_LT(hits, queries);
}

TEST(OsgRealScenes, AgreeInATunnelWithAndWithoutKdTrees) {
  ROAM_NEEDS_TEST_DATA();
  const std::string file = "underground/subt_tunnel_practice_1.ive";
  const roam::World world = lossless_world(file);
  osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile((roam::test::test_data() / file).string());
  ASSERT_NE(scene, nullptr);
  EXPECT_EQ(osgRoam::buildWorld(*scene).stats().triangles, world.stats().triangles);
  compare(*scene, world, 1500);
  osg::ref_ptr<osg::KdTreeBuilder> builder = new osg::KdTreeBuilder;
  scene->accept(*builder);
  compare(*scene, world, 4000);
}

/// Reads every page once.
class Pages : public osgUtil::IntersectionVisitor::ReadCallback {
 public:
  osg::ref_ptr<osg::Node> readNodeFile(const std::string& file) override {
    osg::ref_ptr<osg::Node>& page = pages_[file];
    if (page == nullptr) page = osgDB::readRefNodeFile(file);
    return page;
  }

 private:
  std::map<std::string, osg::ref_ptr<osg::Node>> pages_;
};

TEST(OsgRealScenes, FindThePagesOfThePitWithOpenSceneGraphsOwnVisitor) {
  ROAM_NEEDS_TEST_DATA();
  const roam::World world = lossless_world("pit_osgb");
  const auto root = roam::test::test_data() / "pit_osgb/Data/Tile_+000_+000/Tile_+000_+000.osgb";
  const osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile(root.string());
  const osg::ref_ptr<Pages> pages = new Pages;
  clutter::Random random(22);
  for (int i = 0; i < 500; ++i) {
    const Vec3 from(random.between(5.0, 315.0), random.between(5.0, 235.0), 80.0), motion(0.0, 0.0, -80.0);
    osg::ref_ptr<osgRoam::BoxIntersector> box =
        new osgRoam::BoxIntersector({0.4}, {from.x, from.y, from.z}, {from.x, from.y, 0.0});
    osgUtil::IntersectionVisitor visitor(box, pages);
    scene->accept(visitor);
    const roam::Impact ground = world.sweep({0.4}, from, motion);
    ASSERT_EQ(box->containsIntersections(), ground.hit);
    if (ground.hit) {
      ASSERT_NEAR(80.0 * box->getFirstIntersection().time, 80.0 * ground.time, 1e-3);
    }
  }
}

}  // namespace
