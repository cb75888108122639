#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "roam/filtered.h"
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

TEST(Recovery, ABodyInWhichAPlateAppearsPassesItByNoMoveWhateverItsSizeDoesThen) {
  const std::vector<Mesh> meshes{floor_mesh(), [] {
                                   Mesh plate;
                                   add_quad(plate, {-5, -5, 0.8}, {5, -5, 0.8}, {5, 5, 0.8}, {-5, 5, 0.8});
                                   return plate;
                                 }()};
  const World world = World::build(meshes);
  const roam::SizeRegion low{.bounds = {Vec3(-9.0), Vec3(9.0)}, .radius = 0.2, .support_radius = 0.0, .why = "a test"};
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    for (const char* change : {"none", "crouch", "resize", "region"}) {
      for (const double speed : {0.5, 1e-170, 0.0}) {
        SCOPED_TRACE(std::string(to_string(mode)) + ", " + change + ", " + std::to_string(speed));
        roam::Filtered space(world);
        space.ignore_only(std::array<roam::ObjectId, 1>{1});
        Walker w(space, {}, mode, {0.0, 0.0, 0.95});
        static_cast<void>(w.step({}, 0.1));
        space.ignore_only({});
        const std::string what = change;
        if (what == "region") w.set_regions(std::array{low});
        const auto judge = [&](const StepReport& report) {
          Vec3 at = report.from;
          for (const roam::Segment& s : report.segments) {
            const bool crosses = (at.z - 0.8) * (s.position.z - 0.8) < 0.0;
            EXPECT_TRUE(!crosses || s.teleport) << at.z << " to " << s.position.z;
            at = s.position;
          }
        };
        if (what == "resize") {
          static_cast<void>(w.resize(0.1, 0.0));
          judge(w.report());
        }
        judge(w.step({.velocity = {speed, 0.0, 0.0}, .crouch = what == "crouch"}, 0.016));
        EXPECT_TRUE(w.held() || space.clearance(w.body(), w.position(), 0.1).distance > -1e-6);
      }
    }
  }
}

TEST(Recovery, AStartInTheMiddleOfAWallIsHeldAndSaidAndAGhostGetsOut) {
  Mesh m = floor_mesh();
  add_wall(m, 2.0, -10.0, 2.0, 10.0, 0.0, 3.0);
  const World world = build(m);
  Walker w(world, {}, Mode::walk, {2.0, 0.0, 0.95});
  EXPECT_TRUE(w.held());
  EXPECT_TRUE(w.report().has(EventKind::held));
  EXPECT_EQ(w.report().axis_clearance, 0.0);
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

TEST(Recovery, AStartInASlotThatIsAHairTooNarrowIsFreedThroughItsEnd) {
  for (const double end : {0.1, 0.5, 1.0}) {
    Mesh m;
    for (const double y : {-0.2999, 0.2999}) add_wall(m, -5.0, y, end, y, -5.0, 5.0);
    for (const bool lossless : {false, true}) {
      const World world = build(m, lossless);
      const Walker w(world, {}, Mode::fly, {0.0, 0.0, 0.0});
      ASSERT_FALSE(w.held()) << end << " m to its end, lossless " << lossless;
      EXPECT_GT(w.position().x, end);
      EXPECT_LT(w.position().x, end + 0.1);
    }
  }
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

TEST(Recovery, FeetOnTheFloorUnderALowCeilingCrouchThere) {
  for (const double top : {1.12, 1.3, 1.5, 1.79, 1.8}) {
    Mesh m = floor_mesh();
    add_floor(m, -5.0, -5.0, 5.0, 5.0, top);
    for (const bool lossless : {false, true}) {
      const World world = build(m, lossless);
      Walker w(world, {}, Mode::walk, {0.0, 9.0, 0.95});
      for (const double lowest : {0.0, 1e-4, 1e-3, 0.01}) {
        SCOPED_TRACE(testing::Message() << top << ' ' << lowest << ' ' << lossless);
        const StepReport& r = w.place_feet({0.0, 0.0, lowest});
        EXPECT_FALSE(r.held || r.has(EventKind::freed));
        EXPECT_TRUE(r.has(EventKind::crouched));
        EXPECT_TRUE(w.grounded());
        EXPECT_NEAR(w.feet().z, 0.0, near_ground);
        EXPECT_NEAR(w.position().x, 0.0, 1e-3);
      }
      w.place({0.0, 0.0, 0.5 * w.body().height()});
      EXPECT_TRUE(w.crouched() && w.grounded()) << "by the centre of a crouched body";
    }
  }
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
  bool back = false;
  for (int i = 0; i < 900 && !back; ++i) {
    const StepReport& r = w.step({1.4, 0.0, 0.0});
    EXPECT_FALSE(r.held || r.has(EventKind::held));
    back = r.put_back;
    EXPECT_EQ(back, r.has(EventKind::put_back));
    EXPECT_TRUE(!back || !r.segments.empty());
  }
  EXPECT_TRUE(back);
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

TEST(Recovery, AGhostThatSankThroughTheFloorComesBackAboveIt) {
  const World world = build(floor_mesh());
  // The centre below the floor, in it to the neck, a hair above it, and the whole body far below.
  for (const double centre : {-0.1, -0.8, 0.05, -5.0}) {
    Walker w(world, {}, Mode::walk, {0.0, 0.0, 0.95});
    w.set_mode(Mode::ghost);
    for (int i = 0; i < 30; ++i) w.step({{0.0, 0.0, (centre - 0.95) * 2.0}}, frame);
    const StepReport& back = w.set_mode(Mode::walk);
    EXPECT_TRUE(back.has(EventKind::returned)) << centre;
    for (int i = 0; i < 60; ++i) w.step({{1.0, 0.0, 0.0}}, frame);
    EXPECT_TRUE(w.grounded()) << centre;
    EXPECT_NEAR(w.feet().z, 0.0, near_ground) << centre;
    EXPECT_NEAR(w.position().x, 1.0, 0.01) << centre;
  }
}

TEST(Recovery, AGhostThatMeetsGroundAgainOnItsWayComesBackToTheNearestOfIt) {
  Mesh m = floor_mesh();
  add_floor(m, 40.0, -10.0, 60.0, 10.0, 2.0);
  const World world = build(m);
  Walker w(world, {}, Mode::walk, {0.0, 0.0, 0.95});
  w.set_mode(Mode::ghost);
  for (int i = 0; i < 100; ++i) w.step({{50.0, 0.0, 5.0}}, 0.01);  // over the far floor
  for (int i = 0; i < 100; ++i) w.step({{10.0, 0.0, -20.0}}, 0.01);
  ASSERT_LT(w.position().z, -10.0);
  w.set_mode(Mode::walk);
  EXPECT_GT(w.position().x, 49.0);
  EXPECT_GT(w.position().z, 2.0);
}

TEST(Recovery, WhoFliesOutOfTheSceneAndThenWalksIsPutBackToWhereItWalkedLast) {
  const World world = build(floor_mesh());
  Walker w(world, {}, Mode::walk, {0.0, 0.0, 0.95});
  w.set_mode(Mode::fly);
  for (int i = 0; i < 60; ++i) w.step({{50.0, 0.0, 5.0}}, frame);
  w.set_mode(Mode::walk);
  for (int i = 0; i < 300; ++i) w.step({}, frame);
  EXPECT_FALSE(w.held());
  EXPECT_TRUE(w.grounded());
  EXPECT_NEAR(w.position().x, 0.0, 1e-6);
}

TEST(Recovery, WhereNothingIsBelowAtAllABodyIsHeldAndSaysSoByBoth) {
  const World world = build(floor_mesh());
  for (const double centre : {-0.001, -5.0}) {
    Walker w(world, {}, Mode::walk, {0.0, 0.0, centre});
    int put_back = 0;
    for (int i = 0; i < 600; ++i) {
      const StepReport& r = w.step({{1.0, 0.0, 0.0}}, frame);
      put_back += r.put_back;
      EXPECT_EQ(r.held, w.held());
    }
    EXPECT_EQ(put_back, 1) << centre;
    EXPECT_TRUE(w.held()) << centre;
    w.set_mode(Mode::fly);
    EXPECT_FALSE(w.held()) << centre;
    w.step({{1.0, 0.0, 0.0}}, 1.0);
    EXPECT_NEAR(w.position().x, 1.0, 0.01) << centre;
    w.set_mode(Mode::walk);
    w.place_feet({0.0, 0.0, 0.0});
    EXPECT_TRUE(w.grounded() && !w.held()) << centre;
  }
}

TEST(Recovery, WhoSlidesOutOfTheSceneASecondTimeIsHeld) {
  Mesh m;
  scenes::add_quad(m, {-5.0, -5.0, 10.0}, {5.0, -5.0, -10.0}, {5.0, 5.0, -10.0}, {-5.0, 5.0, 10.0});
  const World world = build(m);
  Walker w(world, {}, Mode::walk, {0.0, 0.0, 3.0});
  int put_back = 0;
  for (int i = 0; i < 3000; ++i) put_back += w.step({}, frame).put_back;
  EXPECT_EQ(put_back, 2);
  EXPECT_TRUE(w.held());
}

TEST(Recovery, FeetOnTheFloorStandAndACentreOnTheFloorDoesNot) {
  const World world = build(floor_mesh());
  Walker w(world, {}, Mode::walk, {0.0, 0.0, 5.0});
  w.place({1.0, 0.0, 0.0});
  EXPECT_TRUE(w.held());
  const StepReport& r = w.place_feet({1.0, 2.0, 0.0});
  EXPECT_FALSE(r.held || r.has(EventKind::freed));
  EXPECT_TRUE(w.grounded());
  EXPECT_NEAR(w.feet().z, 0.0, near_ground);
  EXPECT_NEAR(w.position().x, 1.0, 1e-9);
  EXPECT_THROW(w.place_feet({1.0, 2.0, NAN}), roam::Error);
}

TEST(Recovery, FeetArePlacedInTheSizeThatTheBodyHasThere) {
  const World world = build(floor_mesh());
  Walker w(world, WalkerSettings::sphere(0.3), Mode::walk, {0.0, 0.0, 0.35});
  const roam::SizeRegion small{.bounds = {{2.0, -1.0, -1.0}, {4.0, 1.0, 3.0}}, .radius = 0.1};
  w.set_regions({&small, 1});
  w.place_feet({3.0, 0.0, 0.0});
  EXPECT_EQ(w.body().radius, 0.1);
  EXPECT_NEAR(w.feet().z, 0.0, near_ground);
  EXPECT_FALSE(w.report().has(EventKind::freed));
}

TEST(Recovery, AGhostAtRestHasNotMoved) {
  const World world = build(floor_mesh());
  Walker w(world, {}, Mode::ghost, {0.0, 0.0, 0.95});
  EXPECT_TRUE(w.step({}, 0.1).segments.empty());
  EXPECT_EQ(w.step({{1.0, 0.0, 0.0}}, 0.1).segments.size(), 1U);
}

TEST(Recovery, ABodyThatIsHeldWhereItFitsIsToldItsClearance) {
  // Beside the floor, over nothing, half a metre from a wall.
  Mesh m = floor_mesh();
  add_wall(m, 25.8, -10.0, 25.8, 10.0, 0.0, 3.0);
  const World world = build(m);
  const Judge judge(m);
  Walker w(world, {}, Mode::walk, {25.0, 0.0, 1.0});
  const double lowest = 0.3 + 0.5 * 7.0 / 8.0 - 2e-3;  // of what a look tells, space.h
  for (int i = 0; i < 300 && !w.held(); ++i) {
    EXPECT_GE(w.step({}, 1.0 / 60.0).least_axis_clearance, lowest);
  }
  ASSERT_TRUE(w.held() && w.report().put_back);
  for (int i = 0; i < 3; ++i) {
    EXPECT_GE(w.report().axis_clearance, lowest);
    EXPECT_LE(w.report().axis_clearance, judge.distance(w.body(), w.position(), 2.0));
    EXPECT_EQ(w.report().least_axis_clearance, w.report().axis_clearance);
    EXPECT_NEAR(w.report().least_gap, w.report().axis_clearance - 0.3, 1e-12);
    w.step({{1.0, 0.0, 0.0}}, 1.0 / 60.0);
  }
}

TEST(Recovery, AHeldBodyThatBecomesSlimIsToldTheClearanceOfTheSlimOne) {
  // Over a slope that nobody stands on, its head 5 cm under a slab: the axis of a slim body reaches farther up.
  Mesh m;
  add_quad(m, {-1.0, -1.0, -1.0}, {1.0, -1.0, -5.0}, {1.0, 1.0, -5.0}, {-1.0, 1.0, -1.0});
  add_quad(m, {-1.0, -1.0, 0.95}, {1.0, -1.0, 0.95}, {1.0, 1.0, 0.95}, {-1.0, 1.0, 0.95});
  const World world = build(m);
  const Judge judge(m);
  Walker w(world, {}, Mode::walk, {0.0, 0.0, 0.0});
  for (int i = 0; i < 1200 && !w.held(); ++i) w.step({}, 1.0 / 60.0);
  ASSERT_TRUE(w.held());
  EXPECT_NEAR(w.report().axis_clearance, 0.35, 0.01);
  w.resize(0.1, 0.0);
  w.step({}, 0.0);
  ASSERT_FALSE(w.held());
  ASSERT_EQ(w.report().radius, 0.1);
  EXPECT_LE(w.report().axis_clearance, judge.distance(w.body(), w.position(), 2.0));
  EXPECT_GE(w.report().axis_clearance, 0.1 - 1e-6);
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
