#include <gtest/gtest.h>

#include <cmath>

#include "walker_judged.h"

namespace {

using namespace scenes;

TEST(Recovery, StartsExactlyInTouchWithTheFloorWithoutAWord) {
  const Mesh m = floor_mesh();
  Walk w(m, {}, Mode::walk, {0.0, 0.0, 0.9});
  EXPECT_EQ(w.walker.report().events.size(), 1u);
  EXPECT_TRUE(w.walker.report().has(EventKind::placed));
  EXPECT_TRUE(w.walker.grounded());
}

TEST(Recovery, AnEmbeddedStartIsFreedByAShortWay) {
  Mesh m = floor_mesh();
  add_wall(m, 2.0, -10.0, 2.0, 10.0, 0.0, 3.0);
  const World world = build(m);
  const Judge judge(m);
  Walker w(world, {}, Mode::walk, {1.85, 0.0, 0.85});
  EXPECT_TRUE(w.report().has(EventKind::freed));
  EXPECT_FALSE(w.held());
  EXPECT_GE(judge.distance(w.body(), w.position(), 1.0), 0.3 - 1e-6);
  EXPECT_LT(w.position().x, 2.0);  // on its side of the wall
  EXPECT_NEAR(w.position().x, 1.7, 0.01);
  EXPECT_NEAR(w.position().z, 0.9, 0.01);
}

TEST(Recovery, AStartInTheMiddleOfAWallIsHeldAndSaidAndAGhostGetsOut) {
  Mesh m = floor_mesh();
  add_wall(m, 2.0, -10.0, 2.0, 10.0, 0.0, 3.0);
  const World world = build(m);
  Walker w(world, {}, Mode::walk, {2.0, 0.0, 0.95});
  EXPECT_TRUE(w.held());
  EXPECT_TRUE(w.report().has(EventKind::held));
  EXPECT_EQ(w.report().clearance, 0.0);
  w.step({{1.0, 0.0, 0.0}}, 1.0);
  EXPECT_EQ(w.position(), Vec3(2.0, 0.0, 0.95));
  EXPECT_TRUE(w.report().held);
  w.set_mode(Mode::ghost);
  w.step({{1.0, 0.0, 0.0}}, 1.0);
  w.set_mode(Mode::walk);
  EXPECT_FALSE(w.held());
  EXPECT_TRUE(w.grounded());
}

TEST(Recovery, AStartTooNarrowForAnyWayOutIsHeld) {
  Mesh m;
  add_box(m, {-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2});
  const World world = build(m);
  Walker w(world, ball(0.3), Mode::fly, {0.0, 0.0, 0.0});
  EXPECT_TRUE(w.held());
}

TEST(Recovery, AStartUnderALowCeilingCrouches) {
  const Mesh m = low_passage(1.2);
  Walk w(m, {}, Mode::walk, {2.5, 0.0, 0.92});
  EXPECT_TRUE(w.walker.crouched());
  EXPECT_FALSE(w.walker.held());
  w.go({1.4, 0.0, 0.0}, 3.0);
  EXPECT_FALSE(w.walker.crouched());
}

TEST(Recovery, AStartAtTheCentreOfACrouchedBodyCrouchesWhereNothingElseFits) {
  Mesh m = floor_mesh();
  add_box(m, {-5.0, -5.0, 0.0}, {5.0, 5.0, 1.3});
  const World world = build(m);
  Walker w(world, {}, Mode::walk, {0.0, 0.0, 0.56});
  EXPECT_FALSE(w.held());
  EXPECT_TRUE(w.crouched());
  EXPECT_TRUE(w.report().has(EventKind::crouched));
  EXPECT_NEAR(w.feet().z, 0.0, near_ground);
  EXPECT_TRUE(Walker(world, {}, Mode::fly, {0.0, 0.0, 0.56}).held());
}

TEST(Recovery, ABodyThatTouchesAWallWalksAwayFromIt) {
  for (const double gap : {0.0, 1e-9, 1e-6, 1e-4, -1e-5}) {
    Mesh m = floor_mesh();
    add_wall(m, 2.0, -10.0, 2.0, 10.0, 0.0, 3.0);
    const World world = build(m);
    Walker w(world, {}, Mode::walk, {1.7 - gap, 0.0, 0.9 + gap});
    for (int i = 0; i < 60; ++i) w.step({{-1.4, 0.3, 0.0}}, frame);
    EXPECT_NEAR(w.position().x, 0.3, 0.002) << gap;
    EXPECT_NEAR(w.position().y, 0.3, 0.002) << gap;
  }
}

TEST(Recovery, WhereNothingIsBelowItIsPutBackToTheLastSafePlaceAndSaysSo) {
  const Mesh m = floor_mesh();
  Walk w(m, {}, Mode::walk, {15.0, 0.0, 0.95});
  bool held = false;
  for (int i = 0; i < 900 && !held; ++i) {
    const StepReport& r = w.step({1.4, 0.0, 0.0});
    held = r.held;
    if (!held) continue;
    EXPECT_TRUE(r.has(EventKind::held));
    EXPECT_TRUE(r.corners.size() > 0);
  }
  EXPECT_TRUE(held);
  EXPECT_EQ(w.count(EventKind::fell), 1);
  EXPECT_FALSE(w.walker.held());
  EXPECT_TRUE(w.walker.grounded());
  EXPECT_GT(w.feet(), -0.3 * (1.0 - std::sqrt(0.5)) - near_ground);  // on the brink, within the slope limit
  w.go({-1.4, 0.0, 0.0}, 1.0);
  EXPECT_LT(w.walker.position().x, 19.5);
}

TEST(Recovery, InAnEmptyWorldWalkingIsHeldAndFlyingIsFree) {
  const World world;
  Walker w(world, {}, Mode::walk, {1.0, 2.0, 3.0});
  w.step({{1.0, 0.0, 0.0}}, 1.0);
  EXPECT_TRUE(w.report().held);
  EXPECT_EQ(w.position(), Vec3(1.0, 2.0, 3.0));
  w.set_mode(Mode::fly);
  w.step({{1.0, 0.0, 0.0}}, 1.0);
  EXPECT_EQ(w.position(), Vec3(2.0, 2.0, 3.0));
}

TEST(Recovery, AGhostPassesWallsAndReturnsToTheNearestSafePlace) {
  Mesh m = floor_mesh();
  add_wall(m, 2.0, -10.0, 2.0, 10.0, 0.0, 3.0);
  const World world = build(m);
  const Judge judge(m);
  Walker w(world, {}, Mode::ghost, {0.0, 0.0, 0.95});
  w.step({{2.05, 0.0, 0.0}}, 1.0);
  EXPECT_EQ(w.position().x, 2.05);
  w.set_mode(Mode::walk);
  EXPECT_TRUE(w.report().has(EventKind::returned));
  EXPECT_GE(judge.distance(w.body(), w.position(), 1.0), 0.3 - 1e-6);
  EXPECT_NEAR(w.position().x, 2.3, 0.01);
  w.set_mode(Mode::ghost);
  w.step({{1.0, 0.0, 0.0}}, 1.0);
  const Vec3 free = w.position();
  w.set_mode(Mode::walk);
  EXPECT_FALSE(w.report().has(EventKind::returned));
  EXPECT_EQ(w.position(), free);
}

TEST(Recovery, AGhostAtRestHasNotMoved) {
  const World world = build(floor_mesh());
  Walker w(world, {}, Mode::ghost, {0.0, 0.0, 0.95});
  EXPECT_TRUE(w.step({}, 0.1).corners.empty());
  EXPECT_EQ(w.step({{1.0, 0.0, 0.0}}, 0.1).corners.size(), 1U);
}

TEST(Recovery, AHeldBodyIsHeldInEveryModeThatCollides) {
  Mesh m = floor_mesh();
  add_wall(m, 2.0, -10.0, 2.0, 10.0, 0.0, 3.0);
  const World world = build(m);
  Walker w(world, {}, Mode::walk, {2.0, 0.0, 0.95});
  ASSERT_TRUE(w.held());
  EXPECT_TRUE(w.set_mode(Mode::fly).held);
  EXPECT_TRUE(w.held());
  EXPECT_FALSE(w.set_mode(Mode::ghost).held);
  EXPECT_FALSE(w.held());
}

}  // namespace
