// What a walker remembers of the free space around it: how little it asks, and that it forgets in time.

#include <gtest/gtest.h>

#include <cmath>

#include "changing_room.h"

namespace {

using namespace scenes;
using roam::Body;

TEST(WalkerFree, FliesFarFromWallsForManyStepsOnOneAnswer) {
  ChangingRoom room(hall(), true);
  const Judge judge = room.judge();
  Walker w(room, ball(0.3), Mode::fly, {-6.0, 0.0, 0.0});
  const int before = room.asked();
  for (int i = 0; i < 400; ++i) ASSERT_GE(margin(judge, w.step({{1.8, 0.0, 0.0}}, frame), 0.3), 0.0);
  EXPECT_NEAR(w.position().x, 6.0, 1e-9);
  EXPECT_LT(room.asked() - before, 60);
}

TEST(WalkerFree, AWindingFlightBesideAWallAsksOnceInThreeSteps) {
  ChangingRoom room(walled_hall(1.0), true);
  const Judge judge = room.judge();
  Walker w(room, ball(0.3), Mode::fly, {0.1, -4.0, 0.0});
  const int before = room.asked();
  for (int i = 0; i < 300; ++i) {
    const StepReport& r = w.step({{0.07 * std::sin(0.1 * i), 1.4, 0.0}}, frame);
    ASSERT_GE(margin(judge, r, 0.3), 0.0);
    ASSERT_GE(r.axis_clearance, 0.3 + 0.75 * (1.0 - r.to.x - 0.3) - 0.004);
  }
  EXPECT_LE(room.asked() - before, 100);
}

TEST(WalkerFree, AsksNothingWhereItRests) {
  ChangingRoom room(walled_hall(1.0), true);
  Walker w(room, ball(0.3), Mode::fly, {0.0, 0.0, 0.0});
  const double clearance = w.report().axis_clearance;
  const int before = room.asked();
  for (int i = 0; i < 10; ++i) EXPECT_EQ(w.step({}, frame).axis_clearance, clearance);
  EXPECT_EQ(room.asked(), before);
}

TEST(WalkerFree, AsksTwiceAStepOnLevelGround) {
  ChangingRoom room(floor_mesh(), true);
  Walker w(room, {}, Mode::walk, {-5.0, 0.0, 1.0});
  for (int i = 0; i < 5; ++i) w.step({{1.4, 0.0, 0.0}}, frame);
  const int before = room.asked();
  for (int i = 0; i < 100; ++i) w.step({{1.4, 0.0, 0.0}}, frame);
  EXPECT_EQ(room.asked() - before, 200);
}

/// A wall that comes into what was known to be free stops the body, whatever it remembers.
void meet_a_new_wall(bool tells, double speed) {
  SCOPED_TRACE(testing::Message() << "tells: " << tells << ", " << speed << " m/s");
  ChangingRoom room(hall(), tells);
  Walker w(room, ball(0.3), Mode::fly, {-5.0, 0.0, 0.0});
  for (int i = 0; i < 3; ++i) w.step({{speed, 0.0, 0.0}}, frame);
  room.become(walled_hall(w.position().x + 0.302));
  const Judge judge = room.judge();
  for (int i = 0; i < 40; ++i) ASSERT_GE(margin(judge, w.step({{speed, 0.0, 0.0}}, frame), 0.3), 0.0) << i;
  EXPECT_TRUE(w.report().blocked);
}

TEST(WalkerFree, ForgetsWhatWasFreeWhenTheSpaceChanges) {
  meet_a_new_wall(true, 0.3);
  meet_a_new_wall(true, 10.0);
}

TEST(WalkerFree, RemembersNothingOfASpaceThatDoesNotTellItsChanges) {
  meet_a_new_wall(false, 0.3);
  meet_a_new_wall(false, 10.0);
}

TEST(WalkerFree, TellsTheClearanceOfAChangedSpaceWhereItRests) {
  for (const bool tells : {true, false}) {
    ChangingRoom room(hall(), tells);
    Walker w(room, ball(0.3), Mode::fly, {0.0, 0.0, 0.0});
    EXPECT_EQ(w.step({}, frame).axis_clearance, 1.3);
    room.become(walled_hall(0.5));
    const double clearance = w.step({}, frame).axis_clearance;
    EXPECT_LE(clearance, 0.5);
    EXPECT_GE(clearance, 0.3 + 0.2 * 7.0 / 8.0 - 0.002);
  }
}

TEST(WalkerFree, WhatIsFreeForASmallBodyIsNotForALargeOne) {
  ChangingRoom room(walled_hall(0.5), true);
  const Judge judge = room.judge();
  Walker w(room, WalkerSettings::sphere(0.1), Mode::fly, {-1.0, 0.0, 0.0});
  for (int i = 0; i < 6; ++i) w.step({{3.0, 0.0, 0.0}}, frame);
  ASSERT_TRUE(w.resize(0.6, 0.0));
  for (int i = 0; i < 60; ++i) ASSERT_GE(margin(judge, w.step({{3.0, 0.0, 0.0}}, frame)), 0.0) << i;
  EXPECT_NEAR(w.position().x, 0.5 - 0.6, 0.005);
}

TEST(WalkerFree, WhatComesUponAMovingBodyFreesOrHoldsIt) {
  for (const auto& [mode, tells] :
       {std::pair(Mode::fly, true), {Mode::walk, true}, {Mode::fly, false}, {Mode::walk, false}}) {
    for (const double speed : {0.0, 0.5, 50.0}) {
      for (const double ahead : {-0.1, 0.1, 0.25}) {
        SCOPED_TRACE(testing::Message() << to_string(mode) << " at " << speed << " m/s, a wall " << ahead
                                        << " m ahead, " << (tells ? "told" : "not told"));
        ChangingRoom room(hall(), tells);
        Walker w(room, {}, mode, {0.0, 0.0, -4.0});
        for (int i = 0; i < 30; ++i) w.step({}, frame);
        const double wall = w.position().x + ahead;
        room.become(walled_hall(wall));
        const StepReport& r = w.step({{speed, 0.0, 0.0}}, frame);
        EXPECT_TRUE(r.has(EventKind::freed));
        EXPECT_FALSE(r.held);
        // On the side on which its axis was, and nowhere through.
        EXPECT_LT((w.position().x - wall) * ahead, 0.0);
        EXPECT_GE(room.judge().distance(w.body(), w.position(), 1.0), w.settings().radius - 1e-6);
      }
    }
  }
}

TEST(WalkerFree, AHeldBodyIsFreeWhenWhatHeldItIsGone) {
  Mesh thicket = hall();
  for (int i = -20; i <= 20; ++i) {
    add_wall(thicket, 0.1 * i, -2.0, 0.1 * i, 2.0, -3.0, 3.0);
    add_wall(thicket, -2.0, 0.1 * i, 2.0, 0.1 * i, -3.0, 3.0);
  }
  for (const bool tells : {true, false}) {
    ChangingRoom room(thicket, tells);
    Walker w(room, {}, Mode::fly, {0.05, 0.05, 0.0});
    EXPECT_TRUE(w.step({}, frame).held);
    room.become(hall());
    EXPECT_FALSE(w.step({}, frame).held) << tells;
  }
}

TEST(WalkerFree, WhatComesUponABodyThatIsHeldBackFreesIt) {
  ChangingRoom room(hall(), true);
  Walker w(room, ball(0.3), Mode::fly, {0.0, 0.0, 0.0});
  room.limit = 0.0;
  room.become(walled_hall(0.1));
  EXPECT_TRUE(w.step({{5.0, 0.0, 0.0}}, frame).has(EventKind::freed));
  EXPECT_LT(w.position().x, 0.1 - 0.3 + 1e-6);
}

TEST(WalkerFree, ACeilingThatComesUponAWalkerMakesItCrouch) {
  Mesh low = floor_mesh();
  add_box(low, {-19.0, -9.0, 1.375}, {19.0, 9.0, 2.5});  // stored exactly
  ChangingRoom room(floor_mesh(), true);
  Walker w(room, {}, Mode::walk, {0.0, 0.0, 1.0});
  for (int i = 0; i < 30; ++i) w.step({}, frame);
  room.become(low);
  const StepReport& r = w.step({{1.4, 0.0, 0.0}}, frame);
  EXPECT_TRUE(r.has(EventKind::crouched));
  EXPECT_FALSE(r.has(EventKind::freed));
  EXPECT_TRUE(w.crouched());
  EXPECT_NEAR(w.feet().z, 0.0, near_ground);
}

TEST(WalkerFree, AClearanceThatWasLowGrowsAgain) {
  Mesh m = hall();
  add_box(m, {-0.5, -5.0, -5.0}, {0.5, -0.4, 5.0});
  add_box(m, {-0.5, 0.4, -5.0}, {0.5, 5.0, 5.0});
  ChangingRoom room(m, true);
  Walker w(room, ball(0.3), Mode::fly, {-3.0, 0.0, 0.0});
  double least = 2.0;
  for (int i = 0; i < 120; ++i) least = std::min(least, w.step({{3.0, 0.0, 0.0}}, frame).axis_clearance);
  EXPECT_LT(least, 0.4);
  EXPECT_GE(least, 0.3 + 0.1 * 3.0 / 4.0 - 0.004);
  EXPECT_EQ(w.report().axis_clearance, 1.3);
}

TEST(WalkerFree, AWorldThatIsAssignedIsAnotherWorld) {
  for (const double speed : {0.0, 0.3, 3.0}) {
    SCOPED_TRACE(testing::Message() << speed << " m/s");
    Mesh mesh = hall();
    World w = build(mesh);
    const auto before = w.facts().revision;
    Walker walker(w, ball(0.3), Mode::fly, {-2.0, 0.0, 0.0});
    for (int i = 0; i < 5; ++i) walker.step({{0.3, 0.0, 0.0}}, frame);
    mesh = walled_hall(walker.position().x + 0.302);
    w = build(mesh);
    EXPECT_NE(w.facts().revision, before);
    const Judge judge(mesh);
    for (int i = 0; i < 30; ++i) ASSERT_GE(margin(judge, walker.step({{speed, 0.0, 0.0}}, frame), 0.3), 0.0) << i;
  }
}

TEST(WalkerFree, ChangingTheModeInAChangedSpaceFreesTheBody) {
  for (const bool tells : {true, false}) {
    for (const double ahead : {-0.1, 0.0, 0.1, 0.25}) {
      SCOPED_TRACE(testing::Message() << "tells: " << tells << ", a wall " << ahead << " m ahead");
      ChangingRoom room(hall(), tells);
      Walker w(room, {}, Mode::fly, {0.0, 0.0, -3.5});
      w.step({{0.3, 0.0, 0.0}}, frame);
      room.become(walled_hall(w.position().x + ahead));
      const StepReport& r = w.set_mode(Mode::walk);
      EXPECT_NE(r.has(EventKind::freed), r.has(EventKind::held));
      EXPECT_EQ(r.axis_clearance > 0.0, !w.held());
      if (!w.held()) {
        EXPECT_GE(margin(room.judge(), r), 0.0);
      }
    }
  }
}

/// What was told of the body where it is, and of the piece that ends there, is true.
void expect_true_or_none(const ChangingRoom& room, const Walker& w) {
  const StepReport& r = w.report();
  EXPECT_LE(r.axis_clearance, room.judge().distance(w.body(), w.position(), 2.0) + 1e-6);
  for (const roam::Segment& c : r.segments) {
    EXPECT_LE(c.axis_clearance, room.judge().distance(Body::capsule(c.radius, c.height), c.position, 2.0) + 1e-6);
  }
}

TEST(WalkerFree, AWallThatIsTouchedOnTheWayDownIsNoGround) {
  for (const double z : {-0.0, 0.0, 1e-17, -1e-17, 1e-3, -1e-3}) {
    SCOPED_TRACE(z);
    ChangingRoom room(floor_mesh(), true);
    Walker w(room, {}, Mode::walk, {0.0, 0.0, 0.9 + 0.005});
    const double before = w.position().z;
    room.clings = Vec3(-1.0, 0.0, z);
    for (int i = 0; i < 30; ++i) w.step({{0.0, 0.3, 0.0}}, frame);
    EXPECT_NEAR(w.position().z, before, near_ground);
  }
}

TEST(WalkerFree, TellsNoClearanceThatWasTrueOfTheSpaceBefore) {
  for (const bool tells : {true, false}) {
    for (const double ahead : {0.05, 0.2, 0.5}) {
      for (const double radius : {0.1, 0.3, 0.4}) {
        SCOPED_TRACE(testing::Message() << "tells: " << tells << ", a wall " << ahead << " m ahead, " << radius);
        ChangingRoom room(hall(), tells);
        Walker w(room, ball(0.3), Mode::fly, {0.0, 0.0, 0.0});
        w.step({}, frame);
        room.become(walled_hall(ahead));
        w.resize(radius, 0.0);
        expect_true_or_none(room, w);
        if (tells) {
          EXPECT_GE(room.judge().distance(w.body(), w.position(), 2.0), w.body().radius - 1e-6);
        }
        w.set_mode(Mode::fly);
        expect_true_or_none(room, w);
        w.step({}, frame);
        expect_true_or_none(room, w);
        w.step({{-0.1, 0.0, 0.0}}, frame);
        EXPECT_GE(room.judge().distance(w.body(), w.position(), 2.0), w.body().radius - 1e-6);
      }
    }
  }
}

TEST(WalkerFree, ALowBodyIsMeasuredInTheSpaceAsItIs) {
  for (const bool tells : {true, false}) {
    SCOPED_TRACE(tells);
    ChangingRoom room(floor_mesh(), tells);
    Walker w(room, {}, Mode::walk, {0.0, 0.0, 1.0});
    for (int i = 0; i < 30; ++i) w.step({}, frame);
    Mesh beside = floor_mesh();
    add_wall(beside, 0.3005, -5.0, 0.3005, 5.0, -1.0, 3.0);
    room.become(beside);
    w.step({.velocity = Vec3(0.0), .crouch = true}, frame);
    ASSERT_TRUE(w.crouched());
    expect_true_or_none(room, w);
    EXPECT_GE(w.report().least_axis_clearance, 0.3 - 1e-6);
  }
}

/// The least that may be told of a free way or place whose axis is so far from everything.
double least_told(double true_clearance, const WalkerSettings& s, double skin) {
  const double gap = std::min(true_clearance - s.radius, s.clearance_reach);
  return s.radius + 0.75 * gap - 2.0 * skin - 0.002;
}

TEST(WalkerFree, ToldClearancesAreAsNearTheTruthAsIsSaid) {
  Mesh m = hall();
  Random random(5);
  for (int i = 0; i < 60; ++i) {
    const Vec3 at(random.between(-9.0, 9.0), random.between(-9.0, 9.0), random.between(-4.0, 4.0));
    add_box(m, at, at + Vec3(random.between(0.05, 1.0), random.between(0.05, 1.0), random.between(0.05, 1.0)));
  }
  const Judge judge(m);
  const World world = build(m);
  const WalkerSettings settings = WalkerSettings::sphere(0.1);
  Walker w(world, settings, Mode::fly, {0.0, 0.0, 4.5});
  int judged = 0;
  for (int flight = 0; flight < 150; ++flight) {
    const double speed = std::exp(random.between(-2.0, 4.5));
    const Vec3 to(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0));
    const Vec3 wish = to / std::sqrt(to.x * to.x + to.y * to.y + to.z * to.z + 1e-9) * speed;
    for (int i = 0; i < 12; ++i) {
      const StepReport& r = w.step({i % 4 == 3 ? Vec3(0.0) : wish}, frame);
      ASSERT_GE(margin(judge, r, 0.1), 0.0);
      if (!r.contacts.empty() || r.segments.size() > 1) continue;
      const double truth = judge.over(w.body(), r.from, r.to - r.from, 2.0);
      ASSERT_GE(r.axis_clearance, least_told(truth, settings, w.skin())) << flight << " " << i << " " << truth;
      ++judged;
    }
  }
  EXPECT_GT(judged, 1000);
}

TEST(WalkerFree, ToldClearancesAreAsNearTheTruthJustAboveAFloor) {
  const Mesh m = floor_mesh();
  const Judge judge(m);
  const World world = build(m);
  int demands = 0;
  for (int height = 1; height <= 40; ++height) {  // half millimetres
    for (const double speed : {0.1, 1.4, 20.0}) {
      Walker w(world, ball(0.3), Mode::fly, {-5.0, 0.0, 0.3 + 0.0005 * height});
      for (int i = 0; i < 10; ++i) {
        const StepReport& r = w.step({{speed, 0.0, 0.0}}, 0.2 / speed);
        const double truth = judge.over(w.body(), r.from, r.to - r.from, 2.0);
        const double least = least_told(truth, w.settings(), w.skin());
        ASSERT_GE(r.axis_clearance, least) << speed << " " << height << " " << truth;
        ASSERT_LE(r.axis_clearance, truth + 1e-6);
        demands += least > 0.3 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(demands, 500);
}

TEST(WalkerFree, ToldClearancesAreBelowTheTruthOnFoot) {
  const Mesh m = rough_tiling(40, 3);
  const Judge judge(m);
  const World world = build(m);
  for (const double speed : {1.4, 20.0}) {
    Walker w(world, {}, Mode::walk, {-8.0, -8.0, 0.95});
    for (int i = 0; i < 100; ++i) {
      const StepReport& r = w.step({{0.4 * speed, 0.3 * speed, 0.0}}, 0.2 / speed);
      if (r.segments.size() > 1) continue;
      const double truth = judge.over(w.body(), r.from, r.to - r.from, 2.0);
      ASSERT_LE(r.axis_clearance, truth + 1e-6);
    }
  }
}

TEST(WalkerFree, AFlightStraightOnAsksOnceInThreeSteps) {
  ChangingRoom room(floor_mesh(), true);
  Walker w(room, ball(0.3), Mode::fly, {-5.0, 0.0, 1.0});
  const int before = room.asked();
  for (int i = 0; i < 120; ++i) w.step({{1.4, 0.0, 0.0}}, frame);
  EXPECT_LE(room.asked() - before, 40);
}

TEST(WalkerFree, WhoRestsIsToldTheClearanceOfThePlace) {
  Mesh m = hall();
  add_box(m, {-0.05, 0.5, -5.0}, {0.05, 0.6, 5.0});  // a post
  ChangingRoom room(m, true);
  Walker w(room, ball(0.3), Mode::fly, {-1.5, 0.0, 0.0});
  const double passing = w.step({{180.0, 0.0, 0.0}}, frame).axis_clearance;
  EXPECT_LE(passing, 0.5);
  EXPECT_GE(passing, least_told(0.5, w.settings(), w.skin()));
  EXPECT_EQ(w.step({}, frame).axis_clearance, 1.3);
  const int before = room.asked();
  for (int i = 0; i < 10; ++i) EXPECT_EQ(w.step({}, frame).axis_clearance, 1.3);
  EXPECT_EQ(room.asked(), before);
}

TEST(WalkerFree, ALongWayPastAPostSaysLittleOfWhereItEnds) {
  Mesh m = hall();
  add_box(m, {-0.05, 0.5, -5.0}, {0.05, 0.6, 5.0});
  ChangingRoom room(m, true);
  Walker w(room, ball(0.3), Mode::fly, {-0.1, 0.0, 0.0});
  w.step({{-120.0, 0.0, 0.0}}, frame);
  EXPECT_EQ(w.step({{-0.1, 0.0, 0.0}}, frame).axis_clearance, 1.3);
}

TEST(WalkerFree, RemembersAsWellFarFromTheOrigin) {
  Mesh m = hall();
  const Vec3 far(6.4e6, -6.4e6, 3000.0);
  shift(m, far);
  ChangingRoom room(m, true);
  const Judge judge = room.judge();
  Walker w(room, ball(0.3), Mode::fly, far + Vec3(-6.0, 0.0, 0.0));
  const int before = room.asked();
  for (int i = 0; i < 400; ++i) ASSERT_GE(margin(judge, w.step({{1.8, 0.0, 0.0}}, frame), 0.3), 0.0);
  EXPECT_NEAR(w.position().x - far.x, 6.0, 1e-6);
  EXPECT_LT(room.asked() - before, 60);
  for (int i = 0; i < 300; ++i) ASSERT_GE(margin(judge, w.step({{1.8, 0.3, 0.0}}, frame), 0.3), 0.0);
  EXPECT_NEAR(w.position().x - far.x, 10.0 - 0.3, 0.005);
}

TEST(WalkerFree, WhatIsFreeForALowBodyIsNotForATallOne) {
  Mesh m = floor_mesh();
  add_box(m, {1.0, -8.0, 1.3}, {1.1, 8.0, 3.0});  // a lintel
  ChangingRoom room(m, true);
  const Judge judge = room.judge();
  for (const double speed : {0.2, 1.4, 20.0}) {
    SCOPED_TRACE(speed);
    Walker w(room, {}, Mode::walk, {-1.0, 0.0, 1.0});
    bool low = false;
    for (int i = 0; i < static_cast<int>(4.0 / speed / frame); ++i) {
      ASSERT_GE(margin(judge, w.step({{speed, 0.0, 0.0}}, frame), 0.3), 0.0) << i;
      low |= w.crouched();
    }
    EXPECT_TRUE(low);
    EXPECT_FALSE(w.crouched());
    EXPECT_GT(w.position().x, 1.4);
  }
}

}  // namespace
