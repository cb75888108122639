// A device with axes, such as a gamepad, leads the body as the keys do.
#include <cmath>
#include <limits>
#include <numbers>

#include "osg_standing.h"

namespace {

using rig::Standing;
using roam::Vec3;
using Axes = osgRoam::Manipulator::Axes;

TEST(ManipulatorAxes, WalkByAShareOfTheSpeed) {
  Standing r;
  r->look(0.0, 0.0);
  const Vec3 before = r.at();
  r->setAxes({.forward = 0.5});
  r.frames(1.0);
  EXPECT_NEAR(r.at().x - before.x, 0.5 * r->speed(), 0.03);
  r->setAxes({});
  const Vec3 then = r.at();
  r.frames(0.5);
  EXPECT_EQ(r.at(), then);
}

TEST(ManipulatorAxes, AddToTheKeysButNeverBeyondTheSpeed) {
  Standing r;
  r->look(0.0, 0.0);
  const Vec3 before = r.at();
  r->setAxes({.forward = 1.0});
  r.down('w');
  r.frames(1.0);
  EXPECT_NEAR(r.at().x - before.x, r->speed(), 0.05);
}

TEST(ManipulatorAxes, LookAround) {
  Standing r;
  r->look(0.0, 0.0);
  r.frame(1.0 / 60.0);
  r->setAxes({.turn_left = 0.5, .look_up = -0.25});
  r.frames(1.0);
  EXPECT_NEAR(r->yaw(), 0.5, 0.02);
  EXPECT_NEAR(r->pitch(), -0.25, 0.02);
}

TEST(ManipulatorAxes, BringTheGazeToItsRateAndToRestInTheTimeOfEasing) {
  Standing r;
  r->setEasing(0.2);
  r->look(0.0, 0.0);
  r.frame(1.0 / 60.0);
  r->setAxes({.turn_left = 0.5, .look_up = -0.25});
  r.frames(0.1);
  EXPECT_NEAR(r->yaw(), 0.5 * 0.1 * 0.1 / (2.0 * 0.2), 1e-9);
  r.frames(0.9);
  EXPECT_NEAR(r->yaw(), 0.5 * 0.9, 1e-9);
  EXPECT_NEAR(r->pitch(), -0.25 * 0.9, 1e-9);
  r->setAxes({});
  r.frames(0.1);
  EXPECT_NEAR(r->yaw(), 0.5 * (0.9 + 0.075), 1e-9);
  EXPECT_TRUE(r.viewer.continuous);
  r.frames(0.5);
  EXPECT_NEAR(r->yaw(), 0.5, 1e-9);
  EXPECT_FALSE(r.viewer.continuous);
  // A stick that is let go only in part is followed as fast.
  r->look(0.0, 0.0);
  r->setAxes({.turn_left = 1.0});
  r.frames(1.0);
  r->setAxes({.turn_left = 0.1});
  r.frames(0.2);
  const double yaw = r->yaw();
  r.frames(0.1);
  EXPECT_NEAR(r->yaw() - yaw, 0.01, 1e-9);
  // A place that is set is kept.
  r->setFeet({0.0, 0.0, 0.0}, 1.0, 0.0);
  r->setAxes({});
  r.frames(0.1);
  EXPECT_EQ(r->yaw(), 1.0);
}

TEST(ManipulatorAxes, CountForNothingIfTheyAreNoNumbers) {
  Standing r;
  r->look(0.0, 0.0);
  const Vec3 before = r.at();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  r->setAxes({.forward = nan, .right = 1e300, .turn_left = nan, .look_up = nan});
  EXPECT_EQ(r->axes().forward, 0.0);
  EXPECT_EQ(r->axes().right, 1.0);
  r.frames(0.5);
  EXPECT_EQ(r->yaw(), 0.0);
  EXPECT_NEAR(std::abs(r.at().y - before.y), 0.5 * r->speed(), 0.05);
}

}  // namespace
