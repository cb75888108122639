// Where a walk begins when nobody says it: on a floor, and inside where there is an inside.
#include <gtest/gtest.h>

#include "roam/generate.h"
#include "roam/world.h"
#include "scenes/free_start.h"

namespace {

using roam::Vec3;
using roam::World;

constexpr roam::WalkerSettings person{.radius = 0.3, .height = 1.8};

/// A horizontal square about `middle`, facing up or down.
void add_square(roam::Mesh& mesh, const Vec3& middle, double half, bool up) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3& corner : {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)}) {
    mesh.vertices.push_back(middle + half * corner);
  }
  for (std::uint32_t i : {1U, 2U}) {
    mesh.triangles.push_back(up ? std::array{first, first + i, first + i + 1}
                                : std::array{first, first + i + 1, first + i});
  }
}

TEST(FloorSamples, LieOnWhatFacesUp) {
  roam::Mesh mesh;
  for (int i = 0; i < 100; ++i) add_square(mesh, Vec3(3.0 * i, 0.0, 0.0), 1.0, true);
  for (int i = 0; i < 100; ++i) add_square(mesh, Vec3(3.0 * i, 0.0, 3.0), 1.0, false);
  mesh.vertices.insert(mesh.vertices.end(), {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  mesh.triangles.push_back({800, 801, 802});  // a wall
  const auto samples = roam::floor_samples({&mesh, 1}, 50);
  EXPECT_EQ(samples.size(), 50U);
  for (const Vec3& p : samples) EXPECT_EQ(p.z, 0.0);
  // Spread over all of them, not the first fifty.
  EXPECT_GT(samples.back().x, 280.0);
  EXPECT_EQ(roam::floor_samples({&mesh, 1}, 1000).size(), 200U);
}

TEST(FloorSamples, LieOnFloorsOfAFileThatWindsThemTheOtherWay) {
  roam::Mesh mesh;
  add_square(mesh, Vec3(0.0), 1.0, false);
  EXPECT_EQ(roam::floor_samples({&mesh, 1}, 10).size(), 2U);
  EXPECT_TRUE(roam::floor_samples({}, 10).empty());
}

TEST(Start, IsRefusedInAnEmptyScene) {
  const roam::World world;
  for (const roam::Mode mode : {roam::Mode::walk, roam::Mode::fly}) {
    try {
      (void)roam::app::free_start(world, person, mode, {});
      FAIL() << "there is no place in nothing";
    } catch (const roam::Error& error) {
      EXPECT_NE(std::string(error.what()).find("the scene is empty"), std::string::npos) << error.what();
    }
  }
}

TEST(Start, IsFoundInASceneThatIsHigherThanARayIsLong) {
  roam::Mesh mesh;
  add_square(mesh, Vec3(0.0), 100.0, true);
  add_square(mesh, Vec3(5000.0, 0.0, 1.2e6), 1.0, true);
  const roam::World world = roam::World::build({&mesh, 1});
  const Vec3 place = roam::app::free_start(world, person, roam::Mode::walk, {}).place;
  EXPECT_NEAR(place.z, 0.95, 0.1);
}

TEST(Start, IsInTheGalleryAndNotOnTheMountainOverIt) {
  // The gallery is 3 m wide in a landscape of kilometres: a grid of columns over it meets only the landscape.
  const auto meshes = roam::generate::collect(roam::generate::gallery({.triangles = 200'000}));
  const roam::World world = roam::World::build(meshes);
  const Vec3 place = roam::app::free_start(world, person, roam::Mode::walk, roam::floor_samples(meshes)).place;
  EXPECT_TRUE(world.ray(place, {0, 0, 6}).hit) << "no ceiling over " << place.x << ", " << place.y << ", " << place.z;
  int near_walls = 0;
  for (const Vec3& side : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0)}) {
    near_walls += world.ray(place, 10.0 * side).hit ? 1 : 0;
  }
  EXPECT_GE(near_walls, 2);
  EXPECT_GT(world.clearance(roam::Body::capsule(0.3, 1.8), place, 1.0).distance, 0.0);
}

TEST(Start, LetsABodyFlyOverAFloorWithoutARoofAndAroundABlock) {
  roam::Mesh floor, block;
  add_square(floor, Vec3(0.0), 4.0, true);
  for (const double z : {0.0, 1.0}) add_square(block, Vec3(0.0, 0.0, z), 0.5, z > 0.0);
  for (const roam::Mesh& mesh : {floor, block}) {
    const World world = World::build({&mesh, 1});
    const Vec3 start = roam::app::free_start(world, person, roam::Mode::fly, {}).place;
    roam::Walker walker(world, person, roam::Mode::fly, start);
    roam::Wander wander(walker, {.seconds = 20.0});
    while (!wander.done()) {
      wander.advance();
    }
    EXPECT_EQ(wander.result().outcome, roam::Outcome::reached);
    EXPECT_GT(wander.result().length, 5.0);
  }
}

}  // namespace
