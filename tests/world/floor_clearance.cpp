// Floor is found where brute force finds it, and nothing else is, in one world and in many.

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

#include "counted_allocations.h"
#include "floor_oracle.h"
#include "roam/error.h"
#include "roam/patchwork.h"
#include "sanitizer.h"
#include "walker_scenes.h"

namespace {

using roam::Floor;
using roam::Mesh;
using roam::Vec3;

constexpr Vec3 far_away(6.4e6, -6.4e6, 2e3);

TEST(FloorClearance, OfAWorldIsWhatBruteForceSays) {
  clutter::Random random(71);
  for (const Vec3 centre : {Vec3(0.0), far_away}) {
    for (const bool lossless : {false, true}) {
      const Mesh mesh = floor_oracle::scene(random, centre, 90);
      const roam::World world = scenes::build(mesh, lossless);
      floor_oracle::judge(world, floor_oracle::triangles_of(mesh), centre, world.largest_error(), 1500, 1);
    }
  }
}

TEST(FloorClearance, OfAPatchworkIsWhatBruteForceSays) {
  clutter::Random random(72);
  for (const Vec3 centre : {Vec3(0.0), far_away}) {
    const Mesh mesh = floor_oracle::scene(random, centre, 90);
    roam::Patchwork space;
    for (std::size_t part = 0; part < 9; ++part) {
      Mesh some;
      roam::Box box;
      for (std::size_t i = part; i < mesh.triangles.size(); i += 9) {
        const roam::Triangle t = mesh.triangle(i);
        scenes::add_triangle(some, t[0], t[1], t[2]);
        for (const Vec3& v : t) box.include(v);
      }
      space.deliver(space.expect(box), scenes::build(some));
    }
    space.update();
    floor_oracle::judge(space, floor_oracle::triangles_of(mesh), centre, space.largest_error(), 1500, 2);
  }
}

TEST(FloorClearance, SeesWhatIsUnknownAndSaysSo) {
  roam::Patchwork space;
  (void)space.expect({Vec3(1.0, -1.0, -1.0), Vec3(2.0, 1.0, 1.0)});
  space.update();
  const auto c = space.floor_clearance({0.0, 0.25}, Vec3(0.0), 5.0, {.slope_degrees = 45.0});
  ASSERT_TRUE(c.found);
  EXPECT_TRUE(c.unknown);
  EXPECT_NEAR(c.distance, 1.0, 2e-3);
}

TEST(FloorClearance, OfABandPassesOverWhatIsUnknownAboveAndBelow) {
  roam::Patchwork space;
  for (const double z : {-3.0, 0.6}) (void)space.expect({Vec3(-9.0, -9.0, z), Vec3(9.0, 9.0, z + 2.0)});
  Mesh m;
  scenes::add_floor(m, 0.8, -1.0, 3.0, 1.0, 0.0);
  space.deliver(space.expect({Vec3(0.8, -1.0, -0.1), Vec3(3.0, 1.0, 0.1)}), scenes::build(m));
  space.update();
  Floor floor;
  floor.band = 0.25;
  const auto level = space.floor_clearance({0.0, 0.25}, Vec3(0.0), 2.0, floor);
  ASSERT_TRUE(level.found);
  EXPECT_FALSE(level.unknown);
  EXPECT_NEAR(level.distance, 0.8, 2e-3);
  // The plane rises into the upper box 0.35 m from the axis, and sinks into the lower one 0.75 m from it.
  floor.normal = Vec3(-1.0, 0.0, 1.0);
  const auto inclined = space.floor_clearance({0.0, 0.25}, Vec3(0.0), 0.5, floor);
  EXPECT_TRUE(inclined.found && inclined.unknown);
  EXPECT_FALSE(space.floor_clearance({0.0, 0.25}, Vec3(0.0), 0.3, floor).found);
  floor.band = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(space.floor_clearance({0.0, 0.25}, Vec3(0.0), 0.5, floor).unknown) << "no band";
}

TEST(FloorClearance, PassesOverWallsThatAreNearer) {
  Mesh m;
  scenes::add_wall(m, 0.1, -5.0, 0.1, 5.0, -1.0, 2.0);
  scenes::add_floor(m, 0.5, -1.0, 3.0, 1.0, 0.0);
  const roam::World world = scenes::build(m);
  EXPECT_NEAR(world.clearance({0.0, 0.25}, Vec3(0.0), 2.0).distance, 0.1, 2e-3);
  EXPECT_NEAR(world.floor_clearance({0.0, 0.25}, Vec3(0.0), 2.0, {.slope_degrees = 45.0}).distance, 0.5, 2e-3);
  const auto none = world.floor_clearance({0.0, 0.25}, Vec3(-2.0, 0.0, 0.0), 2.0, {.slope_degrees = 45.0});
  EXPECT_FALSE(none.found);
  EXPECT_EQ(none.distance, 2.0);
}

TEST(FloorClearance, OfABandPassesOverTheBottomOfAPit) {
  Mesh m;
  scenes::add_floor(m, -1.0, -1.0, 1.0, 1.0, -0.4);
  scenes::add_floor(m, 1.0, -1.0, 3.0, 1.0, 0.0);
  const roam::World world = scenes::build(m);
  Floor floor;
  floor.band = 0.25;
  EXPECT_NEAR(world.floor_clearance({0.0, 0.25}, Vec3(0.0), 2.0, {.slope_degrees = 45.0}).distance, 0.15, 2e-3);
  EXPECT_NEAR(world.floor_clearance({0.0, 0.25}, Vec3(0.0), 2.0, floor).distance, 1.0, 2e-3);
}

TEST(FloorClearance, OfATiltedBandSeesTheWholeRamp) {
  Mesh m;  // 45 degrees, the lower half missing
  scenes::add_quad(m, {1.0, -1.0, 1.0}, {3.0, -1.0, 3.0}, {3.0, 1.0, 3.0}, {1.0, 1.0, 1.0});
  const roam::World world = scenes::build(m);
  Floor floor;
  floor.band = 0.25;
  EXPECT_FALSE(world.floor_clearance({0.0, 2.0}, Vec3(0.0), 2.0, floor).found);
  floor.normal = {-1.0, 0.0, 1.0};
  EXPECT_NEAR(world.floor_clearance({0.0, 2.0}, Vec3(0.0), 2.0, floor).distance, 1.0, 2e-3);
}

TEST(FloorClearance, RefusesAFloorOutOfRange) {
  const roam::World world;
  const auto refuses = [&](const Floor& floor) {
    EXPECT_THROW((void)world.floor_clearance({0.1}, Vec3(0.0), 1.0, floor), roam::Error);
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double slope : {-1.0, 89.1, nan}) refuses({.slope_degrees = slope});
  for (const double band : {-1e-9, nan}) refuses({.band = band});
  refuses({.band = 1.0, .point = Vec3(nan)});
  for (const Vec3& normal : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, 0.0, -1.0), Vec3(nan)})
    refuses({.band = 1.0, .normal = normal});
  EXPECT_THROW((void)world.floor_clearance({-0.1}, Vec3(0.0), 1.0, {.slope_degrees = 45.0}), roam::Error);
  EXPECT_THROW((void)world.floor_clearance({0.1}, Vec3(nan), 1.0, {.slope_degrees = 45.0}), roam::Error);
}

TEST(FloorClearance, DoesNotAllocate) {
  ROAM_NEEDS_PLAIN_MEMORY();
  clutter::Random random(73);
  const Mesh mesh = floor_oracle::scene(random, Vec3(0.0), 200);
  const roam::World world = scenes::build(mesh);
  const long before = allocations;
  double sum = 0.0;
  for (int i = 0; i < 500; ++i) {
    Floor floor;
    floor.band = 0.25;
    sum += world.floor_clearance({0.0, 0.25}, random.in_box(4.0), 1.0, floor).distance;
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(sum, 0.0);
}

}  // namespace
