#include "roam/standing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "roam/error.h"
#include "walker_scenes.h"

namespace {

using roam::Mesh;
using roam::Mode;
using roam::Vec3;
using roam::Walker;
using roam::WalkerSettings;
using roam::World;

constexpr double near_ground = 5e-3;

/// Two storeys, 3 m apart, with a low table on the lower one.
Mesh storeys() {
  Mesh m;
  scenes::add_floor(m, -10.0, -10.0, 10.0, 10.0, 0.0);
  scenes::add_floor(m, -10.0, -10.0, 10.0, 10.0, 3.0);
  scenes::add_floor(m, -1.0, -1.0, 1.0, 1.0, 1.0);
  return m;
}

TEST(PlaceToStand, IsOnTheNearestFloorWithRoomAndCanBeWalkedFrom) {
  const World world = scenes::build(storeys());
  for (const double z : {0.9, 3.9}) {
    const auto place = roam::place_to_stand(world, {}, {5.0, 5.0, z + 0.2}, 2.0);
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->z, z, near_ground);
    EXPECT_NEAR(place->x, 5.0, 1e-6);
    Walker w(world, {}, Mode::walk, *place);
    EXPECT_TRUE(w.grounded() && w.stance().firm());
    EXPECT_NEAR(w.position().z, place->z, 1e-3);
    EXPECT_FALSE(w.report().has(roam::EventKind::freed));
    EXPECT_TRUE(world.fits(w.body(), *place));
  }
}

TEST(PlaceToStand, GoesAsideWhereThereIsNoRoomAndNoFartherThanItMay) {
  Mesh m;
  scenes::add_floor(m, -10.0, -10.0, 10.0, 10.0, 0.0);
  scenes::add_box(m, {-1.0, -1.0, 0.0}, {1.0, 1.0, 1.5});
  scenes::add_floor(m, -10.0, -10.0, 10.0, 10.0, 3.0);  // nobody stands on the box under it, nor in the box
  const World world = scenes::build(m);
  EXPECT_FALSE(roam::place_to_stand(world, {}, {0.0, 0.0, 0.9}, 1.2));
  const auto place = roam::place_to_stand(world, {}, {0.0, 0.0, 0.9}, 3.0);
  ASSERT_TRUE(place);
  EXPECT_GE(std::max(std::abs(place->x), std::abs(place->y)), 1.3 - 1e-6);
  EXPECT_LT(std::hypot(place->x, place->y), 1.6);
  EXPECT_NEAR(place->z, 0.9, near_ground);
}

TEST(PlaceToStand, IsNoneOnWhatIsTooSteepAndWhereNothingIs) {
  Mesh m;
  scenes::add_quad(m, {-5.0, -5.0, 10.0}, {5.0, -5.0, -10.0}, {5.0, 5.0, -10.0}, {-5.0, 5.0, 10.0});
  EXPECT_FALSE(roam::place_to_stand(scenes::build(m), {}, {0.0, 0.0, 1.0}, 2.0));
  EXPECT_FALSE(roam::place_to_stand(World(), {}, {0.0, 0.0, 1.0}, 2.0));
}

TEST(PlaceToStand, IsNoneOutsideAllSpace) {
  Mesh m;
  scenes::add_floor(m, -5.0, -5.0, 5.0, 5.0, 1e9 - 0.5);
  EXPECT_FALSE(roam::place_to_stand(scenes::build(m), {}, {0.0, 0.0, 1e9 - 0.5}, 2.0));
}

TEST(PlaceToStand, RefusesWhatIsNoQuestion) {
  const World world = scenes::build(storeys());
  EXPECT_THROW((void)roam::place_to_stand(world, {}, {NAN, 0.0, 0.0}, 1.0), roam::Error);
  for (const double within : {0.0, -1.0, static_cast<double>(NAN), 1e9}) {
    EXPECT_THROW((void)roam::place_to_stand(world, {}, Vec3(0.0), within), roam::Error) << within;
  }
  EXPECT_THROW((void)roam::place_to_stand(world, {.radius = -1.0}, Vec3(0.0), 1.0), roam::Error);
}

TEST(Fits, IsTrueExactlyWhereASweepStartsFree) {
  const World world = scenes::build(storeys());
  const roam::Body ball{.radius = 0.3};
  EXPECT_TRUE(world.fits(ball, {5.0, 5.0, 0.31}));
  EXPECT_FALSE(world.fits(ball, {5.0, 5.0, 0.29}));
  EXPECT_FALSE(world.fits(ball, {5.0, 5.0, 0.0}));
}

TEST(Landing, SaysHowFastABodyCameToGround) {
  const World world = scenes::build(storeys());
  Walker w(world, {}, Mode::walk, {5.0, 5.0, 3.9 + 2.0});
  double landed = 0.0;
  for (int i = 0; i < 120; ++i) landed = std::max(landed, w.step({}, 1.0 / 60.0).landing_speed);
  EXPECT_NEAR(landed, std::sqrt(2.0 * 9.81 * 2.0), 0.1);
  EXPECT_EQ(w.report().landing_speed, 0.0);
  w.step({.jump = true}, 1.0 / 60.0);
  landed = 0.0;
  for (int i = 0; i < 120; ++i) landed = std::max(landed, w.step({}, 1.0 / 60.0).landing_speed);
  EXPECT_NEAR(landed, std::sqrt(2.0 * 9.81 * 0.5), 0.1);
}

}  // namespace
