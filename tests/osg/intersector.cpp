// The intersector against brute force, in graphs of every kind.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <initializer_list>
#include <osg/Camera>
#include <osg/KdTree>
#include <osg/MatrixTransform>
#include <osg/Projection>
#include <osgUtil/IntersectionVisitor>

#include "osgRoam/BoxIntersector.h"
#include "osgRoam/Triangles.h"
#include "osg_graphs.h"
#include "roam/error.h"

namespace {

using osg_graphs::Graph;
using osg_graphs::Maker;
using osg_graphs::Random;
using osg_graphs::to_osg;
using osg_graphs::to_roam;
using osgRoam::BoxIntersector;
using roam::Body;
using roam::Vec3;

/// Metres. Doubles are 1e-9 apart at 6.4e6 m, and scaled frames multiply that.
constexpr double tolerance = 1e-6;

osg::ref_ptr<BoxIntersector> ask(osg::Node& scene, const Body& body, const Vec3& from, const Vec3& motion,
                                 double margin = 0.0,
                                 osgUtil::Intersector::IntersectionLimit limit = BoxIntersector::LIMIT_NEAREST,
                                 bool kd_tree = true) {
  osg::ref_ptr<BoxIntersector> box = new BoxIntersector(body, to_osg(from), to_osg(from + motion));
  box->setBoundsMargin(margin);
  box->setIntersectionLimit(limit);
  osgUtil::IntersectionVisitor visitor(box);
  visitor.setUseKdTreeWhenAvailable(kd_tree);
  scene.accept(visitor);
  return box;
}

struct Counts {
  int hits = 0, misses = 0;
};

/// A random query, judged by all triangles.
void judge(const Graph& graph, double margin, Random& random, const Vec3& centre, Counts& counts, bool kd_tree) {
  const Body body{random.engine() % 8 == 0 ? 0.0 : random.between(0.05, 0.8),
                  random.engine() % 2 == 0 ? 0.0 : random.between(0.1, 1.0)};
  const Vec3 from = centre + random.in_box(6.0);
  const Vec3 to = from + (random.engine() % 10 == 0 ? Vec3(0.0) : random.in_box(3.0));
  const Vec3 motion = to - from;
  const auto box = ask(*graph.root, body, from, motion, margin, BoxIntersector::LIMIT_NEAREST, kd_tree);
  if (!box->containsIntersections()) {
    ++counts.misses;
    const double least = osg_graphs::least_distance(graph.triangles, body, from, motion, 1.0);
    ASSERT_GE(least, body.radius - tolerance) << "missed";
    return;
  }
  ++counts.hits;
  const auto hit = box->getFirstIntersection();
  const Vec3 there = from + motion * hit.time;
  const double least = osg_graphs::least_distance(graph.triangles, body, from, motion, hit.time);
  if (hit.time > 0.0) {
    ASSERT_GE(least, body.radius - tolerance) << "late";
  }
  ASSERT_LE(osg_graphs::least_distance(graph.triangles, body, there, Vec3(0.0), 1.0), body.radius + tolerance)
      << "early";
  // The point is on the body's surface, or inside it at the start, and the normal leads to the axis.
  const Vec3 point = to_roam(hit.worldIntersectionPoint), normal = to_roam(hit.worldIntersectionNormal);
  ASSERT_NEAR(glm::length(normal), 1.0, 1e-9);
  if (hit.time > 0.0) {
    const Vec3 away = point + normal * body.radius - there;
    ASSERT_NEAR(std::max(std::abs(away.x), std::abs(away.y)), 0.0, 1e-4);
    ASSERT_LE(std::abs(away.z), body.half_height + 1e-4);
  }
  // Local and world point are one.
  const osg::Vec3d back = hit.matrix.valid() ? hit.localIntersectionPoint * *hit.matrix : hit.localIntersectionPoint;
  ASSERT_LE((back - hit.worldIntersectionPoint).length(), 1e-4);  // inverses are good to 1e-11 of 6.4e6 m
  ASSERT_FALSE(hit.nodePath.empty());
  ASSERT_EQ(hit.nodePath.front(), graph.root.get());
}

void judge_many(std::uint64_t seed, const osg_graphs::Recipe& recipe, int graphs, int queries) {
  Random random(seed);
  Counts counts;
  for (int g = 0; g < graphs; ++g) {
    const Graph graph = Maker(random, recipe).make();
    const double margin = osgRoam::boundsMargin(*graph.root);
    if (recipe.kd_tree_friendly) {
      osg::ref_ptr<osg::KdTreeBuilder> builder = new osg::KdTreeBuilder;
      graph.root->accept(*builder);
    }
    for (int q = 0; q < queries; ++q) {
      judge(graph, margin, random, recipe.centre, counts, q % 4 != 0);
      if (testing::Test::HasFatalFailure()) FAIL() << "graph " << g << ", query " << q;
    }
  }
  EXPECT_GT(counts.hits, graphs * queries / 20);
  EXPECT_GT(counts.misses, graphs * queries / 20);
}

TEST(OsgIntersector, MissesNothingAtTheOrigin) { judge_many(1, {}, 150, 200); }

TEST(OsgIntersector, MissesNothingAtTheGallery) { judge_many(2, {.centre = {-13739, 253, 182}}, 100, 200); }

TEST(OsgIntersector, MissesNothingInNationalGrids) { judge_many(3, {.centre = {504123, 5678901, 90}}, 100, 200); }

TEST(OsgIntersector, MissesNothingOnTheGlobe) { judge_many(4, {.centre = {-6.4e6, 1e5, 6.3e6}}, 100, 200); }

TEST(OsgIntersector, MissesNothingWithKdTrees) {
  judge_many(5, {.geometries = 4, .kd_tree_friendly = true}, 100, 100);
  judge_many(6, {.centre = {504123, 5678901, 90}, .geometries = 4, .kd_tree_friendly = true}, 50, 100);
}

/// A square floor of 2 m at height `z`, as one quad.
osg::ref_ptr<osg::Geometry> floor_at(double z, double half = 1.0) {
  osg::ref_ptr<osg::Vec3dArray> vertices = new osg::Vec3dArray;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    vertices->push_back(osg::Vec3d(half * x, half * y, z));
  }
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setVertexArray(vertices);
  geometry->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, 4));
  return geometry;
}

TEST(OsgIntersector, AgreesWithTheWorldOfTheSameGraph) {
  Random random(7);
  roam::BuildOptions lossless;
  lossless.threads = 1;
  lossless.lossless = true;
  for (int g = 0; g < 40; ++g) {
    const Graph graph = Maker(random, {}).make();
    const double margin = osgRoam::boundsMargin(*graph.root);
    const roam::World world = osgRoam::buildWorld(*graph.root, osg::Vec3d(), lossless);
    EXPECT_EQ(world.stats().triangles, graph.triangles.size());
    for (int q = 0; q < 100; ++q) {
      const Body body{random.between(0.1, 0.6), 0.4};
      const Vec3 from = random.in_box(6.0), motion = random.in_box(3.0);
      const auto box = ask(*graph.root, body, from, motion, margin);
      const roam::Impact impact = world.sweep(body, from, motion);
      const double length = glm::length(motion);
      EXPECT_NEAR(box->getFirstIntersection().time * length, impact.hit ? impact.time * length : length, 2e-3);
    }
  }
}

TEST(OsgIntersector, GivesWhatTheLimitSays) {
  osg::ref_ptr<osg::Group> scene = new osg::Group;
  for (const double z : {0.0, -1.0, -2.0}) scene->addChild(floor_at(z));
  const Body body{0.25};
  const Vec3 from(0.3, 0.1, 1.0), motion(0.0, 0.0, -5.0);
  const auto times = [&](osgUtil::Intersector::IntersectionLimit limit) {
    std::vector<double> z;
    const auto box = ask(*scene, body, from, motion, 0.0, limit);
    for (const auto& i : box->getIntersections()) {
      z.push_back(std::round((from.z + motion.z * i.time - body.radius) * 1e6) / 1e6);
    }
    return z;
  };
  EXPECT_EQ(times(BoxIntersector::LIMIT_NEAREST), std::vector<double>{0.0});
  EXPECT_EQ(times(BoxIntersector::LIMIT_ONE).size(), 1u);
  EXPECT_EQ(times(BoxIntersector::LIMIT_ONE_PER_DRAWABLE), (std::vector<double>{0.0, -1.0, -2.0}));
  // Each floor is two triangles, whose diagonal the body touches, too.
  EXPECT_EQ(times(BoxIntersector::NO_LIMIT).size(), 6u);
}

TEST(OsgIntersector, NamesWhatItHits) {
  osg::ref_ptr<osg::MatrixTransform> turned =
      new osg::MatrixTransform(osg::Matrixd::scale(1.0, 1.0, 3.0) * osg::Matrixd::translate(0.0, 0.0, 7.0));
  osg::ref_ptr<osg::Geometry> floor = floor_at(-1.0);
  turned->addChild(floor);
  osg::ref_ptr<osg::Group> scene = new osg::Group;
  scene->addChild(turned);
  const auto hit = ask(*scene, {0.5}, {0.2, 0.5, 6.0}, {0.0, 0.0, -3.0})->getFirstIntersection();
  EXPECT_EQ(hit.drawable, floor);
  EXPECT_EQ(hit.nodePath, (osg::NodePath{scene, turned, floor}));
  EXPECT_EQ(hit.primitiveIndex, 0u);
  EXPECT_EQ(hit.feature, roam::Feature::face);
  EXPECT_NEAR(hit.time, 0.5, 1e-9);
  EXPECT_NEAR(hit.localIntersectionPoint.z(), -1.0, 1e-9);
  EXPECT_NEAR(hit.worldIntersectionPoint.z(), 4.0, 1e-9);
  EXPECT_NEAR(hit.worldIntersectionNormal.z(), 1.0, 1e-12);
  EXPECT_NEAR(hit.localIntersectionNormal.z(), 1.0, 1e-12);
}

TEST(OsgIntersector, StartsAnewAfterReset) {
  osg::ref_ptr<osg::Geometry> floor = floor_at(0.0);
  osg::ref_ptr<BoxIntersector> box = new BoxIntersector({0.5}, {0, 0, 1}, {0, 0, -1});
  osgUtil::IntersectionVisitor visitor(box);
  floor->accept(visitor);
  EXPECT_TRUE(box->containsIntersections());
  visitor.reset();
  EXPECT_FALSE(box->containsIntersections());
  osg::ref_ptr<osg::Geometry> lower = floor_at(-0.9);
  lower->accept(visitor);
  ASSERT_TRUE(box->containsIntersections());
  EXPECT_NEAR(box->getFirstIntersection().time, 0.7, 1e-9);
}

TEST(OsgIntersector, GathersCandidates) {
  osg::ref_ptr<osg::Group> scene = new osg::Group;
  scene->addChild(floor_at(0.0));
  scene->addChild(floor_at(-9.0));
  osg::ref_ptr<BoxIntersector> box = new BoxIntersector({0.5}, {0, 0, 1}, {0, 0, -1});
  box->setGatherCandidates(true);
  osgUtil::IntersectionVisitor visitor(box);
  scene->accept(visitor);
  EXPECT_FALSE(box->containsIntersections());
  ASSERT_EQ(box->getCandidates().size(), 2u) << "both halves of the quad, and none of the far floor";
  for (const roam::Triangle& triangle : box->getCandidates()) {
    for (const roam::Vec3& corner : triangle) EXPECT_EQ(corner.z, 0.0);
  }
}

TEST(OsgIntersector, FindsThroughAFlatteningTransform) {
  // The shadow of a box on the floor: nothing can be brought back through that matrix.
  osg::ref_ptr<osg::MatrixTransform> shadow = new osg::MatrixTransform(osg::Matrixd::scale(1.0, 1.0, 0.0));
  shadow->setCullingActive(false);
  osg::ref_ptr<osg::Geometry> box = floor_at(40.0);
  osg::ref_ptr<osg::Vec3Array> floats = new osg::Vec3Array;
  for (const osg::Vec3d& v : *static_cast<const osg::Vec3dArray*>(box->getVertexArray())) floats->push_back(v);
  box->setVertexArray(floats);
  shadow->addChild(box);
  const auto hit = ask(*shadow, {0.5}, {0.2, 0.1, 1.5}, {0, 0, -2})->getFirstIntersection();
  EXPECT_NEAR(hit.time, 0.5, 1e-9);
  EXPECT_NEAR(hit.localIntersectionPoint.x(), 0.2, 1e-9);
  EXPECT_NEAR(hit.localIntersectionPoint.z(), 40.0, 1e-9);
}

TEST(OsgIntersector, FindsThroughTransformsThatFlattenAlmost) {
  // Here there is an inverse, which is good for nothing.
  Random random(9);
  const auto turn = [&] { return osg::Matrixd::rotate(random.between(0.0, 6.28), to_osg(random.direction())); };
  for (int i = 0; i < 300; ++i) {
    osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
    for (int c = 0; c < 3; ++c) corners->push_back(osg::Vec3(to_osg(random.in_box(5.0))));
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(corners);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    osg::ref_ptr<osg::MatrixTransform> flat =
        new osg::MatrixTransform(turn() * osg::Matrixd::scale(1.0, 1.0, 1e-15) * turn());
    flat->setCullingActive(false);
    flat->addChild(geometry);
    Vec3 middle(0.0);
    for (const osg::Vec3& corner : *corners) middle += osg_graphs::placed(corner, flat->getMatrix()) / 3.0;
    ASSERT_TRUE(ask(*flat, {0.1}, middle, Vec3(0.0))->containsIntersections()) << i;
  }
}

TEST(OsgIntersector, FindsTrianglesThatAKdTreeHasDropped) {
  // A triangle that is written as a quad, and a segment, among others.
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  for (int i = 0; i < 8; ++i) {
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      const bool folded = i == 3 && x == 0 && y == 1;
      vertices->push_back(osg::Vec3(3.0f * i + (folded ? 1 : x), folded ? 1 : y, 0.0f));
    }
  }
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setVertexArray(vertices);
  geometry->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, 32));
  osg::ref_ptr<osg::KdTreeBuilder> builder = new osg::KdTreeBuilder;
  geometry->accept(*builder);
  const auto* tree = dynamic_cast<osg::KdTree*>(geometry->getShape());
  ASSERT_NE(tree, nullptr);
  ASSERT_EQ(tree->_degenerateCount, 1u);
  for (int i = 0; i < 8; ++i) {
    EXPECT_TRUE(ask(*geometry, {0.1}, {3.0 * i + 0.8, 0.3, 1.0}, {0, 0, -2})->containsIntersections()) << i;
  }
}

TEST(OsgIntersector, UsesAKdTreeOnlyWhereTheVisitorDoes) {
  // A tree of other vertices than the geometry's own would show: this one's are moved afterwards.
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  for (int i = 0; i < 8; ++i) {
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      vertices->push_back(osg::Vec3(3.0f * i + x, y, 0.0f));
    }
  }
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setVertexArray(vertices);
  geometry->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, 32));
  osg::ref_ptr<osg::KdTreeBuilder> builder = new osg::KdTreeBuilder;
  geometry->accept(*builder);
  for (osg::Vec3& v : *vertices) v.z() += 10.0f;
  geometry->dirtyBound();
  const Body body{0.1};
  const Vec3 from{0.5, 0.5, 11.0}, motion{0, 0, -2};
  EXPECT_FALSE(ask(*geometry, body, from, motion)->containsIntersections());
  EXPECT_TRUE(ask(*geometry, body, from, motion, 0.0, BoxIntersector::LIMIT_NEAREST, false)->containsIntersections());
  // New vertices are noticed.
  geometry->setVertexArray(new osg::Vec3Array(*vertices));
  EXPECT_TRUE(ask(*geometry, body, from, motion)->containsIntersections());
}

TEST(OsgIntersector, MeasuresHowFarBoundsAreOff) {
  // Rotated, then scaled unevenly, OpenSceneGraph's sphere is too small: 7.1 m where the quad reaches 9.9 m.
  osg::ref_ptr<osg::MatrixTransform> sheared = new osg::MatrixTransform(
      osg::Matrixd::rotate(0.25 * 3.14159265358979, osg::Vec3d(0, 0, 1)) * osg::Matrixd::scale(1.0, 7.0, 1.0));
  sheared->addChild(floor_at(0.0));
  osg::ref_ptr<osg::Group> scene = new osg::Group;
  scene->addChild(sheared);
  const Body body{0.1};
  const Vec3 from{0.0, 9.7, 1.0}, motion{0, 0, -2};
  EXPECT_FALSE(ask(*scene, body, from, motion)->containsIntersections());
  const double margin = osgRoam::boundsMargin(*scene);
  EXPECT_NEAR(margin, 9.899 - scene->getBound().radius(), 0.01);
  EXPECT_TRUE(ask(*scene, body, from, motion, margin)->containsIntersections());
}

TEST(OsgIntersector, AllowsForTheRoundingOfBounds) {
  Random random(8);
  for (int i = 0; i < 2000; ++i) {
    // A tip that a far transform's sphere, whose floats are 0.5 m apart there, may leave out.
    osg::ref_ptr<osg::MatrixTransform> far = new osg::MatrixTransform(
        osg::Matrixd::translate(504123.0 + random.unit(), 5678901.0 + random.unit(), 90.0 + random.unit()));
    osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
    const Vec3 out = random.direction();
    for (const double s : {-2.0, 2.0}) corners->push_back(osg::Vec3(to_osg(s * out)));
    corners->push_back(osg::Vec3(0.1f, 0.0f, 0.0f));
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(corners);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    far->addChild(geometry);
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(far);
    const Vec3 tip = osg_graphs::placed((*corners)[1], far->getMatrix());
    ASSERT_TRUE(ask(*scene, {0.1}, tip + 0.099 * out, Vec3(0.0))->containsIntersections()) << i;
  }
}

TEST(OsgIntersector, WorksInTheFrameOfAView) {
  osg::ref_ptr<osg::Camera> camera = new osg::Camera;
  camera->setViewMatrix(osg::Matrixd::translate(0.0, 0.0, -5.0));
  camera->addChild(floor_at(3.0));
  osg::ref_ptr<BoxIntersector> box = new BoxIntersector(osgUtil::Intersector::VIEW, {0.5}, {0, 0, 0}, {0, 0, -4});
  osgUtil::IntersectionVisitor visitor(box);
  camera->accept(visitor);
  EXPECT_NEAR(box->getFirstIntersection().time, 1.5 / 4.0, 1e-9);
}

TEST(OsgIntersector, RefusesWhatHasNoRadius) {
  const auto make = [](osgUtil::Intersector::CoordinateFrame frame, const Body& body, const osg::Vec3d& end) {
    return osg::ref_ptr<BoxIntersector>(new BoxIntersector(frame, body, {}, end));
  };
  EXPECT_NO_THROW(make(osgUtil::Intersector::MODEL, {0.5}, {}));
  EXPECT_THROW(make(osgUtil::Intersector::WINDOW, {0.5}, {}), roam::Error);
  EXPECT_THROW(make(osgUtil::Intersector::PROJECTION, {0.5}, {}), roam::Error);
  EXPECT_THROW(make(osgUtil::Intersector::MODEL, {-1.0}, {}), roam::Error);
  EXPECT_THROW(make(osgUtil::Intersector::MODEL, {0.5}, {0, 0, std::nan("")}), roam::Error);
}

TEST(OsgIntersector, FindsTrianglesWhoseNormalUnderflows) {
  for (const double edge : {1e-200, 1e-85, 1e-82, 1e-70}) {
    osg::ref_ptr<osg::Vec3dArray> vertices = new osg::Vec3dArray;
    for (const auto& corner : {osg::Vec3d(0, 0, 0.1), osg::Vec3d(edge, 0, 0.1), osg::Vec3d(0, edge, 0.1)}) {
      vertices->push_back(corner);
    }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    EXPECT_TRUE(ask(*geometry, {0.5}, {0, 0, 0}, {0, 0, 0})->containsIntersections()) << edge;
  }
}

TEST(OsgIntersector, PassesHeadUpDisplays) {
  const osg::ref_ptr<osg::Camera> camera = new osg::Camera;
  const osg::ref_ptr<osg::MatrixTransform> fixed = new osg::MatrixTransform, turning = new osg::MatrixTransform;
  camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  fixed->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  turning->setReferenceFrame(osg::Transform::ABSOLUTE_RF_INHERIT_VIEWPOINT);
  const osg::ref_ptr<osg::Projection> projection = new osg::Projection;
  for (osg::Group* display : std::initializer_list<osg::Group*>{camera, fixed, turning, projection}) {
    display->addChild(floor_at(0.0));
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(display);
    EXPECT_FALSE(ask(*scene, {0.5}, {0, 0, 1}, {0, 0, -2})->containsIntersections()) << display->className();
    EXPECT_TRUE(osgRoam::collectMeshes(*scene).empty()) << display->className();
  }
}

}  // namespace
