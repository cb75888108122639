// A scene graph as a space: the same answers as the world of the same triangles, and what is not loaded is solid.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <osg/LOD>
#include <osg/PagedLOD>
#include <osg/ProxyNode>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>
#include <vector>

#include "floor_oracle.h"
#include "import_files.h"
#include "osgRoam/SceneSpace.h"
#include "osgRoam/Triangles.h"
#include "osg_graphs.h"
#include "roam/error.h"
#include "roam/walker.h"

namespace {

using osg_graphs::Graph;
using osg_graphs::Maker;
using osg_graphs::Random;
using osgRoam::SceneSpace;
using roam::Body;
using roam::Vec3;

double gap(const Graph& graph, const Body& body, const Vec3& from, const Vec3& motion, double time) {
  return osg_graphs::least_distance(graph.triangles, body, from, motion, time) - body.radius;
}

void judge_against_brute_force(std::uint64_t seed, const osg_graphs::Recipe& recipe, int graphs, int queries) {
  constexpr double tolerance = 1e-6;
  Random random(seed);
  int hits = 0, near = 0;
  for (int g = 0; g < graphs; ++g) {
    const Graph graph = Maker(random, recipe).make();
    const SceneSpace space(graph.root);
    for (int q = 0; q < queries; ++q) {
      const Body body{random.between(0.05, 0.8), random.engine() % 2 == 0 ? 0.0 : random.between(0.1, 1.0)};
      const Vec3 from = recipe.centre + random.in_box(6.0), motion = random.in_box(3.0);
      const roam::Impact impact = space.sweep(body, from, motion);
      hits += impact.hit ? 1 : 0;
      if (impact.time > 0.0) {
        ASSERT_GE(gap(graph, body, from, motion, impact.time), -tolerance);
      }
      if (impact.hit) {
        ASSERT_LE(gap(graph, body, from + impact.time * motion, Vec3(0.0), 1.0), tolerance);
      }
      const roam::Clearance clearance = space.clearance(body, from, motion, 1.5);
      const double truth = gap(graph, body, from, motion, 1.0);
      near += clearance.found ? 1 : 0;
      ASSERT_LE(clearance.distance, std::max(truth, -body.radius) + tolerance);
      // Where the axis itself meets a triangle brute force cannot tell how deep.
      if (truth > -body.radius + 1e-9) {
        ASSERT_GE(clearance.distance, std::min(truth, 1.5) - tolerance);
      }
      std::vector<roam::Contact> contacts(graph.triangles.size() + 1);
      const std::size_t count = space.contacts(body, from, motion, 0.5, contacts);
      std::vector<double> gaps;
      for (const auto& t : graph.triangles) {
        const double d = static_cast<double>(oracle::least_distance(body, from, motion, 1.0, t)) - body.radius;
        if (d <= 0.5 - tolerance) gaps.push_back(d);
      }
      ASSERT_GE(count, gaps.size());
      ASSERT_TRUE(std::is_sorted(contacts.begin(), contacts.begin() + static_cast<std::ptrdiff_t>(count),
                                 [](const auto& a, const auto& b) { return a.distance < b.distance; }));
      std::vector<roam::TriangleId> ids;
      for (std::size_t i = 0; i < count; ++i) ids.push_back(contacts[i].triangle);
      std::sort(ids.begin(), ids.end());
      ASSERT_EQ(std::unique(ids.begin(), ids.end()), ids.end()) << "a number for two triangles";
    }
  }
  EXPECT_GT(hits, graphs * queries / 20);
  EXPECT_GT(near, graphs * queries / 20);
}

TEST(OsgSceneSpace, AnswersAsBruteForceDoes) { judge_against_brute_force(11, {}, 60, 80); }

TEST(OsgSceneSpace, AnswersAsBruteForceDoesFarAway) {
  judge_against_brute_force(12, {.centre = {504123, 5678901, 90}}, 40, 80);
}

TEST(OsgSceneSpace, FindsTheFloorThatBruteForceFinds) {
  clutter::Random random(13);
  const roam::Mesh mesh = floor_oracle::scene(random, Vec3(0.0), 90);
  osg::ref_ptr<osg::Vec3dArray> vertices = new osg::Vec3dArray;
  for (const Vec3& v : mesh.vertices) vertices->push_back({v.x, v.y, v.z});
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setVertexArray(vertices);
  geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, static_cast<int>(vertices->size())));
  const osg::Vec3d origin(1000.0, -2000.0, 300.0);
  const SceneSpace space(geometry, origin);
  std::vector<roam::Triangle> triangles = floor_oracle::triangles_of(mesh);
  const Vec3 centre(origin.x(), origin.y(), origin.z());
  for (roam::Triangle& t : triangles) {
    for (Vec3& v : t) v += centre;
  }
  floor_oracle::judge(space, triangles, centre, 1e-6, 600, 4);
}

osg::ref_ptr<osg::Geometry> square(const osg::Vec3d& at, double half, const std::string& name) {
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    vertices->push_back(osg::Vec3(at + osg::Vec3d(half * x, half * y, 0.0)));
  }
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setVertexArray(vertices);
  geometry->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, 4));
  geometry->setName(name);
  return geometry;
}

TEST(OsgSceneSpace, CarriesAWalker) {
  osg::ref_ptr<osg::Group> scene = new osg::Group;
  scene->addChild(square({0, 0, 0}, 20.0, "floor"));
  osg::ref_ptr<osg::MatrixTransform> upright =
      new osg::MatrixTransform(osg::Matrixd::rotate(0.5 * 3.14159265358979, osg::Vec3d(0, 1, 0)));
  upright->addChild(square({0, 0, 5}, 3.0, "wall"));
  scene->addChild(upright);
  const osg::Vec3d origin(504000.0, 5678000.0, 0.0);
  const SceneSpace space(scene, origin);
  const Vec3 start(504000.0, 5678000.0, 0.95);
  roam::Walker walker(space, {.radius = 0.3, .height = 1.8}, roam::Mode::walk, start);
  for (int i = 0; i < 300; ++i) walker.step({.velocity = Vec3(2.0, 0.0, 0.0)}, 1.0 / 30.0);
  EXPECT_NEAR(walker.position().x, 504005.0 - 0.3, 1e-3);
  EXPECT_NEAR(walker.position().z, 0.9, 1e-2);
  const roam::Impact ahead = space.sweep(walker.body(), walker.position(), {1.0, 0.0, 0.0});
  ASSERT_TRUE(ahead.hit);
  EXPECT_EQ(space.object_name(ahead.triangle), "wall");
  EXPECT_FALSE(ahead.unknown);
  EXPECT_NEAR(ahead.point.x, 504005.0, 1e-6);
}

TEST(OsgSceneSpace, SeesChangesAtOnce) {
  osg::ref_ptr<osg::Switch> scene = new osg::Switch;
  scene->addChild(square({0, 0, 0}, 5.0, "gate"));
  const SceneSpace space(scene);
  const auto open = [&] { return !space.sweep({0.3}, {0, 0, 1}, {0, 0, -2}).hit; };
  EXPECT_FALSE(open());
  scene->setAllChildrenOff();
  EXPECT_TRUE(open());
  scene->setAllChildrenOn();
  scene->addChild(square({50, 0, 0}, 5.0, "another"));
  EXPECT_FALSE(open());
  EXPECT_TRUE(space.sweep({0.3}, {50, 0, 1}, {0, 0, -2}).hit);
}

TEST(OsgSceneSpace, DoesNotDependOnAnEye) {
  osg::ref_ptr<osg::LOD> lod = new osg::LOD;
  lod->addChild(square({0, 0, 0}, 5.0, "fine"), 10.0f, 100.0f);  // OpenSceneGraph's own visitor leaves this one out
  lod->addChild(square({0, 0, 1}, 5.0, "coarse"), 100.0f, 1e9f);
  osg::ref_ptr<osg::Group> scene = new osg::Group;
  scene->addChild(lod);
  const SceneSpace space(scene);
  const roam::Impact down = space.sweep({0.3}, {0, 0, 3}, {0, 0, -4});
  ASSERT_TRUE(down.hit);
  EXPECT_EQ(space.object_name(down.triangle), "fine");
}

/// Reads files below a folder and counts.
class Reader : public osgUtil::IntersectionVisitor::ReadCallback {
 public:
  explicit Reader(const std::filesystem::path& folder) : folder_(folder) {}
  osg::ref_ptr<osg::Node> readNodeFile(const std::string& file) override {
    ++count;
    return osgDB::readRefNodeFile((folder_ / file).string());
  }
  int count = 0;

 private:
  std::filesystem::path folder_;
};

/// Tiles of 10 m, whose coarse and fine floors lie at different heights.
osg::ref_ptr<osg::PagedLOD> tile(double x, bool coarse, const std::string& file) {
  osg::ref_ptr<osg::PagedLOD> lod = new osg::PagedLOD;
  lod->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
  lod->setCenter(osg::Vec3(static_cast<float>(x), 0, 0));
  lod->setRadius(8.0f);
  unsigned next = 0;
  if (coarse) lod->addChild(square({x, 0, 1}, 5.0, "coarse"), 50.0f, 1e9f), ++next;
  lod->setFileName(next, file);
  lod->setRange(next, 0.0f, 50.0f);
  return lod;
}

TEST(OsgSceneSpace, ReadsPagesAndKnowsWhatItCannotKnow) {
  const roam::test::TemporaryFolder folder;
  ASSERT_TRUE(osgDB::writeNodeFile(*square({0, 0, 0}, 5.0, "fine"), (folder.path() / "here.osgt").string()));
  osg::ref_ptr<osg::MatrixTransform> scene = new osg::MatrixTransform(osg::Matrixd::translate(0, 0, 100));
  scene->addChild(tile(0.0, true, "here.osgt"));
  scene->addChild(tile(20.0, true, "gone.osgt"));
  scene->addChild(tile(40.0, false, "gone_too.osgt"));
  osg::ref_ptr<osg::ProxyNode> proxy = new osg::ProxyNode;
  proxy->setFileName(0, "gone_as_well.osgt");
  proxy->setCenterMode(osg::ProxyNode::USER_DEFINED_CENTER);
  proxy->setCenter(osg::Vec3(60, 0, 0));
  proxy->setRadius(8.0f);
  scene->addChild(proxy);
  SceneSpace space(scene);
  const auto below = [&](double x) {
    const roam::Impact down = space.sweep({0.25}, {x, 0, 150}, {0, 0, -100});
    return down.hit ? space.object_name(down.triangle) + (down.unknown ? "?" : "") : "nothing";
  };
  EXPECT_EQ(below(0.0), "coarse");
  EXPECT_EQ(below(20.0), "coarse");
  EXPECT_EQ(below(40.0), "gone_too.osgt?");
  EXPECT_EQ(below(60.0), "gone_as_well.osgt?");
  EXPECT_EQ(below(80.0), "nothing");
  osg::ref_ptr<Reader> reader = new Reader(folder.path());
  space.setReadCallback(reader);
  EXPECT_EQ(below(0.0), "fine");
  EXPECT_EQ(below(20.0), "coarse");
  EXPECT_EQ(below(40.0), "gone_too.osgt?");
  const int before = reader->count;
  EXPECT_EQ(below(80.0), "nothing");
  EXPECT_EQ(reader->count, before) << "reads what the body is far from";
  // The border lies where the sphere's box does.
  const roam::Impact border = space.sweep({0.25}, {40, 0, 150}, {0, 0, -100});
  EXPECT_NEAR(150.0 - 100.0 * border.time, 108.25, 1e-3);
  EXPECT_LE(space.clearance({0.25}, {40, 0, 109}, 5.0).distance, 0.75);
  EXPECT_TRUE(space.clearance({0.25}, {40, 0, 109}, 5.0).unknown);
  // Inside of it nothing moves.
  EXPECT_EQ(space.sweep({0.25}, {40, 0, 100}, {1, 0, 0}).time, 0.0);
}

TEST(OsgSceneSpace, IsNotSolidEverywhereForAFileThatIsNowhere) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  osg::ref_ptr<osg::PagedLOD> sizeless = new osg::PagedLOD;
  sizeless->setFileName(0, "sizeless.osgt");
  sizeless->setRange(0, 0.0f, 50.0f);
  osg::ref_ptr<osg::ProxyNode> proxy = new osg::ProxyNode;
  proxy->setFileName(0, "proxy.osgt");
  osg::ref_ptr<osg::PagedLOD> endless = tile(0.0, false, "endless.osgt");
  endless->setRadius(static_cast<float>(inf));
  osg::ref_ptr<osg::PagedLOD> astray = tile(nan, false, "astray.osgt");
  for (const double bad : {nan, inf}) {
    osg::ref_ptr<osg::MatrixTransform> nowhere = new osg::MatrixTransform(osg::Matrixd::translate(0, bad, 0));
    nowhere->addChild(tile(0.0, false, "nowhere.osgt"));
    nowhere->addChild(square({0, 0, 0}, 5.0, "nowhere"));
    for (const osg::ref_ptr<osg::Node>& node :
         std::vector<osg::ref_ptr<osg::Node>>{sizeless, proxy, endless, astray, nowhere}) {
      osg::ref_ptr<osg::Group> scene = new osg::Group;
      scene->addChild(square({0, 0, 0}, 5.0, "floor"));
      scene->addChild(node);
      const SceneSpace space(scene, {100, 0, 0});
      const roam::Impact down = space.sweep({0.25}, {100, 0, 1}, {0, 0, -2});
      ASSERT_TRUE(down.hit);
      EXPECT_NEAR(down.time, 0.375, 1e-6);
      EXPECT_EQ(space.object_name(down.triangle), "floor");
      EXPECT_FALSE(space.sweep({0.25}, {100, 0, 1}, {0, 0, 1}).hit);
      EXPECT_NEAR(space.clearance({0.25}, {100, 0, 1}, 5.0).distance, 0.75, 1e-6);
      EXPECT_FALSE(space.clearance({0.25}, {100, 0, 9}, 5.0).found);
      const roam::Box bounds = space.bounds();
      EXPECT_LE(bounds.lower.x, 95.0);
      EXPECT_GE(bounds.upper.x, 105.0);
      EXPECT_GT(bounds.lower.x, 80.0);
      EXPECT_LT(bounds.upper.x, 120.0);
      EXPECT_EQ(space.getUnplacedFiles().size(), 1u);
    }
  }
}

TEST(OsgSceneSpace, BoundsWhatIsThereBesideVerticesThatAreNotFinite) {
  osg::ref_ptr<osg::Geometry> broken = square({0, 0, 0}, 5.0, "broken");
  static_cast<osg::Vec3Array*>(broken->getVertexArray())
      ->push_back(osg::Vec3(std::numeric_limits<float>::infinity(), 0, 0));
  broken->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 2, 3));
  osg::ref_ptr<osg::Group> scene = new osg::Group;
  scene->addChild(broken);
  scene->addChild(tile(20.0, false, "gone.osgt"));
  const SceneSpace space(scene);
  const roam::Impact down = space.sweep({0.25}, {0, 0, 1}, {0, 0, -2});
  ASSERT_TRUE(down.hit);
  EXPECT_EQ(space.object_name(down.triangle), "broken");
  EXPECT_TRUE(space.sweep({0.25}, {20, 0, 10}, {0, 0, -2}).unknown);
  const roam::Box bounds = space.bounds();
  EXPECT_NEAR(bounds.lower.x, -5.0, 1e-3);
  EXPECT_NEAR(bounds.upper.x, 28.0, 1e-3);
}

TEST(OsgSceneSpace, GivesWhatIsUnknownRoomForTheRoundingOfItsSphere) {
  // The sphere of a file that was written in doubles, rounded to floats.
  const osg::Vec3d centre(5678901.3, 0.0, 0.0);
  const SceneSpace space(tile(centre.x(), false, "gone.osgt"), -centre);
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE(space.sweep({0.1}, {side * 8.05, 0, 0}, Vec3(0.0)).unknown);
    const roam::Impact border = space.sweep({0.1}, {side * 100.0, 0, 0}, {-side * 100.0, 0, 0});
    ASSERT_TRUE(border.hit);
    EXPECT_LT(100.0 - 100.0 * border.time, 8.1 + 33.0 * 0x1p-24 * centre.x());
  }
}

TEST(OsgSceneSpace, LeavesOutWhatTheOthersLeaveOut) {
  osg::ref_ptr<osg::Camera> display = new osg::Camera;
  display->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  display->addChild(square({0, 0, 0}, 5.0, "display"));
  osg::ref_ptr<osg::Geometry> hidden = square({0, 0, 0}, 5.0, "hidden");
  hidden->setNodeMask(0);
  osg::ref_ptr<osg::Group> scene = new osg::Group;
  scene->addChild(display);
  scene->addChild(hidden);
  EXPECT_FALSE(SceneSpace(scene).sweep({0.3}, {0, 0, 1}, {0, 0, -2}).hit);
  EXPECT_TRUE(osgRoam::collectMeshes(*scene).empty());
}

TEST(OsgSceneSpace, RefusesWhatNoSpaceTakes) {
  osg::ref_ptr<osg::Group> scene = new osg::Group;
  const SceneSpace space(scene);
  EXPECT_THROW((SceneSpace(nullptr)), roam::Error);
  SceneSpace other(scene);
  for (const double margin : {-1.0, std::nan(""), HUGE_VAL}) EXPECT_THROW(other.setBoundsMargin(margin), roam::Error);
  EXPECT_NO_THROW(static_cast<void>(other.sweep({0.3}, Vec3(0.0), Vec3(0.0))));
  EXPECT_THROW(static_cast<void>(space.sweep({-1.0}, Vec3(0.0), Vec3(0.0))), roam::Error);
  EXPECT_THROW(static_cast<void>(space.clearance({0.3}, Vec3(std::nan("")), 1.0)), roam::Error);
  EXPECT_TRUE(space.bounds().empty());
}

}  // namespace
