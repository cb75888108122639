// Bodies in made scenes: Table 1 as the paper tells it, into the grottos, into the buildings.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "roam/generate.h"
#include "roam/route.h"
#include "roam/walker.h"
#include "roam/world.h"
#include "surface_check.h"

namespace roam::generate {
namespace {

Outcome walk(const World& world, Mode mode, const WalkerSettings& body, const std::vector<Vec3>& way, double speed) {
  Walker walker(world, body, mode, way.front());
  Route route(walker, way, {.speed = speed});
  while (!route.done()) route.advance();
  return route.result().outcome;
}

WalkerSettings sphere(double radius) { return {.radius = radius, .height = 2.0 * radius, .eye = radius}; }

bool ends_with(const std::string& s, const std::string& end) {
  return s.size() >= end.size() && s.compare(s.size() - end.size(), end.size(), end) == 0;
}

class GenerateWalk : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    meshes_ = new std::vector<Mesh>(collect(gallery({.triangles = 100'000})));
    world_ = new World(World::build(*meshes_));
  }
  static void TearDownTestSuite() {
    delete world_;
    delete meshes_;
  }
  static std::vector<Vec3> way(int path) {
    const Path& p = gallery_paths[static_cast<std::size_t>(path - 1)];
    return {p.from, p.to};
  }

  static std::vector<Mesh>* meshes_;
  static World* world_;
};

std::vector<Mesh>* GenerateWalk::meshes_ = nullptr;
World* GenerateWalk::world_ = nullptr;

TEST_F(GenerateWalk, ASphereFliesPathsOneAndTwoAtThePapersSpeed) {
  for (const int path : {1, 2}) EXPECT_EQ(walk(*world_, Mode::fly, sphere(0.5), way(path), 50.0), Outcome::reached);
}

TEST_F(GenerateWalk, APersonWalksPathsOneAndTwo) {
  for (const int path : {1, 2}) EXPECT_EQ(walk(*world_, Mode::walk, {}, way(path), 5.0), Outcome::reached);
}

TEST_F(GenerateWalk, ASmallSphereFallsIntoTheSplitOfPathThree) {
  for (const double radius : {0.3, 0.5, 0.62}) {
    EXPECT_EQ(walk(*world_, Mode::walk, sphere(radius), way(3), 1.5), Outcome::fell) << radius;
  }
}

TEST_F(GenerateWalk, ALargeSphereCrossesTheSplitOfPathThree) {
  for (const double radius : {0.7, 0.8, 0.9}) {
    EXPECT_EQ(walk(*world_, Mode::walk, sphere(radius), way(3), 1.5), Outcome::reached) << radius;
  }
}

TEST_F(GenerateWalk, ABoxAroundTheSphereIsCaughtOnBothSidesOfTheGateOfPathTwo) {
  // What the sphere passes by 0.1 m on either side stops a method that tests the sphere's bounding box.
  constexpr double radius = 0.5;
  const auto meets = [&](const Vec3& centre, const std::string& name) {
    for (const Mesh& m : *meshes_) {
      if (m.name != name) continue;
      for (std::size_t i = 0; i < m.triangles.size(); ++i) {
        const Triangle t = m.triangle(i);
        constexpr int steps = 32;
        for (int a = 0; a <= steps; ++a) {
          for (int b = 0; a + b <= steps; ++b) {
            const Vec3 p = t[0] + (t[1] - t[0]) * (double(a) / steps) + (t[2] - t[0]) * (double(b) / steps) - centre;
            if (std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) < radius) return true;
          }
        }
      }
    }
    return false;
  };
  const Path& path = gallery_paths[1];
  bool both = false;
  for (double t = 0.0; t < 0.02; t += 0.0002) {  // the first 9 m
    const Vec3 centre = path.from + (path.to - path.from) * t;
    both =
        both || (meets(centre, "upper_gallery/corner_gate_left") && meets(centre, "upper_gallery/corner_gate_right"));
  }
  EXPECT_TRUE(both);
}

TEST_F(GenerateWalk, APersonEntersEveryGrottoAndASphereOfEightyCentimetresNone) {
  int grottos = 0;
  for (const Mesh& m : *meshes_) {
    if (!ends_with(m.name, "/door")) continue;
    ++grottos;
    const Box box = box_of({m});
    // The lower gallery runs along path 3, the upper one along paths 1 and 2.
    const bool lower = m.name.rfind("lower", 0) == 0;
    const Path& first = gallery_paths[0];
    const bool before_corner = box.center().x < first.to.x;
    const Path& path = gallery_paths[lower ? 2 : before_corner ? 0 : 1];
    const Vec3 d = path.to - path.from;
    const double length = std::sqrt(d.x * d.x + d.y * d.y);
    const Vec3 left{-d.y / length, d.x / length, 0.0};
    const WalkerSettings person;
    const Vec3 at_door{box.center().x, box.center().y, box.lower.z + 0.5 * person.height + 0.02};
    EXPECT_EQ(walk(*world_, Mode::walk, person, {at_door - left * 1.75, at_door + left * 1.1}, 1.4), Outcome::reached)
        << m.name;
    const Vec3 low = at_door + Vec3{0.0, 0.0, -0.45};
    EXPECT_EQ(walk(*world_, Mode::walk, sphere(0.4), {low - left * 1.75, low + left * 1.1}, 1.4), Outcome::blocked)
        << m.name;
  }
  EXPECT_GT(grottos, 30);
}

TEST(GenerateWalkCity, APersonEntersTheSecondRoomOfEveryBuildingOfABlock) {
  const std::vector<Mesh> meshes = collect(city({.triangles = 60'000}));
  const World world = World::build(meshes);
  int entered = 0;
  for (const Mesh& m : meshes) {
    if (m.name.rfind("block_000_000/", 0) != 0 || !ends_with(m.name, "/interior")) continue;
    // The door is where the interior is open. Lots 0 and 1 face -y, 2 and 3 face +y.
    Box door;
    for (const Vec3& p : open_rim({m})) door.include(p);
    const bool upper = m.name.find("building_2") != std::string::npos || m.name.find("building_3") != std::string::npos;
    const Vec3 inwards{0.0, upper ? -1.0 : 1.0, 0.0};
    const WalkerSettings person;
    const Vec3 at_door{door.center().x, door.center().y, door.lower.z + 0.5 * person.height + 0.02};
    const std::vector<Vec3> way{at_door - inwards * 5.0, at_door + inwards * 2.0, at_door + inwards * 6.0};
    EXPECT_EQ(walk(world, Mode::walk, person, way, 1.4), Outcome::reached) << m.name;
    ++entered;
  }
  EXPECT_EQ(entered, 4);
}

}  // namespace
}  // namespace roam::generate
