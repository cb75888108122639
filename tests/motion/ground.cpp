#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "walker_judged.h"

namespace {

using namespace scenes;

struct Stairs {
  double rise, tread;
};

/// Ten stairs up from x = 1 and a landing. Without risers they are boards with a nosing of 3 cm.
Mesh stairs(const Stairs& stair, bool risers) {
  Mesh m = floor_mesh();
  for (int i = 0; i < 10; ++i) {
    const double x = 1.0 + stair.tread * i, z = stair.rise * i;
    if (risers) add_wall(m, x, -2.0, x, 2.0, z, z + stair.rise);
    add_floor(m, risers ? x : x - 0.03, -2.0, i == 9 ? 15.0 : x + stair.tread, 2.0, z + stair.rise);
  }
  return m;
}

TEST(Ground, StairsAreClimbedAndComeDownAtAnySpeed) {
  for (const Stairs& stair : {Stairs{0.17, 0.28}, Stairs{0.20, 0.23}, Stairs{0.25, 0.25}, Stairs{0.28, 0.35}}) {
    for (const bool risers : {true, false}) {
      const Mesh m = stairs(stair, risers);
      for (const double speed : {0.3, 1.4, 5.0}) {
        for (const WalkerSettings& settings : {WalkerSettings{}, ball(0.3), ball(0.5)}) {
          SCOPED_TRACE(testing::Message() << stair.rise << " by " << stair.tread << " m, risers " << risers
                                          << ", speed " << speed << ", radius " << settings.radius);
          Walk w(m, settings, Mode::walk, {-0.5, 0.0, 0.5 * settings.height + 0.01});
          w.go({speed, 0.0, 0.0}, 6.0 / speed);
          EXPECT_NEAR(w.feet(), 10.0 * stair.rise, near_ground);
          EXPECT_GE(w.count(EventKind::stepped_up), 5);
          EXPECT_EQ(w.count(EventKind::airborne), 0);
          w.go({-speed, 0.0, 0.0}, 6.5 / speed);
          EXPECT_NEAR(w.feet(), 0.0, near_ground);
          EXPECT_EQ(w.count(EventKind::fell), 0);
          if (speed < 2.0) {
            EXPECT_EQ(w.count(EventKind::airborne), 0);
          }
        }
      }
    }
  }
}

/// A slope of 86 degrees in ledges: each is a step up, of several pieces.
TEST(Ground, AStepOverManyLedgesEndsWhereItsReportIsFull) {
  Mesh m;
  constexpr double tread = 0.019, rise = 0.3;
  add_floor(m, -100.0, -500.0, 0.0, 500.0, 0.0);
  for (int i = 0; i < 60; ++i) {
    add_wall(m, tread * i, -500.0, tread * i, 500.0, rise * i, rise * (i + 1));
    add_floor(m, tread * i, -500.0, tread * (i + 1), 500.0, rise * (i + 1));
  }
  const WalkerSettings settings{.height = 1.4, .eye = 1.3, .step = 0.5, .slope_degrees = 75.0};
  Walk w(m, settings, Mode::walk, {-0.6, 0.0, 0.72});
  for (int i = 0; i < 4; ++i) {
    const Vec3 from = w.walker.position();
    const StepReport& r = w.step({1.4, 0.0, 0.0}, 0.5);
    EXPECT_EQ(r.segments.total(), r.segments.size());
    EXPECT_TRUE(r.has(EventKind::throttled));
    // Over each ledge a step up moves the body a little farther than its speed does.
    EXPECT_NEAR(w.walker.position().x - from.x, 1.4 * r.elapsed, 0.05);
    EXPECT_GT(w.walker.position().z - from.z, 3.0);
  }
}

TEST(Ground, StepsOntoAKerbOfStepHeightAtAnySpeedButNotOntoAHigherOne) {
  for (const double speed : {0.05, 0.5, 1.4, 7.0}) {
    for (const double height : {0.05, 0.15, 0.29, 0.31, 0.5}) {
      Mesh m = floor_mesh();
      add_wall(m, 1.0, -2.0, 1.0, 2.0, 0.0, height);
      add_floor(m, 1.0, -2.0, 15.0, 2.0, height);
      Walk w(m, {}, Mode::walk, {0.68, 0.0, 0.95});
      w.go({speed, 0.0, 0.0}, 1.0 / speed);
      SCOPED_TRACE(testing::Message() << "speed " << speed << ", kerb " << height);
      if (height < 0.3) {
        EXPECT_NEAR(w.feet(), height, near_ground);
        EXPECT_NEAR(w.walker.position().x, 1.68, 0.1);
      } else {
        EXPECT_NEAR(w.feet(), 0.0, near_ground);
        EXPECT_LT(w.walker.position().x, 0.7);
        EXPECT_TRUE(w.walker.report().blocked);
      }
    }
  }
}

TEST(Ground, StepsOntoAKerbUnderACeilingThatFalls) {
  for (const double fall : {0.0, 0.01, 0.05, 0.1}) {
    Mesh m = floor_mesh();
    add_wall(m, 1.0, -2.0, 1.0, 2.0, 0.0, 0.22);
    add_floor(m, 1.0, -2.0, 15.0, 2.0, 0.22);
    const double near = 2.08 + 2.0 * fall, far = 2.08 - 2.0 * fall;  // 2.08 m over the kerb's edge
    add_quad(m, {-1.0, -2.0, near}, {3.0, -2.0, far}, {3.0, 2.0, far}, {-1.0, 2.0, near});
    for (const double speed : {0.5, 1.4, 7.0}) {
      Walk w(m, {}, Mode::walk, {0.3, 0.0, 0.95});
      w.go({speed, 0.0, 0.0}, 1.1 / speed);
      EXPECT_NEAR(w.feet(), 0.22, near_ground) << "falls by " << fall << ", speed " << speed;
      EXPECT_GE(w.walker.position().x, 1.2);
    }
  }
}

TEST(Ground, StepsDownALedgeOfStepHeightAndFallsFromAHigherOne) {
  for (const double depth : {0.28, 0.2999, 0.32, 0.5}) {
    Mesh m;
    add_floor(m, -5.0, -5.0, 1.0, 5.0, 0.0);
    add_wall(m, 1.0, -5.0, 1.0, 5.0, -depth, 0.0);
    add_floor(m, 1.0, -5.0, 10.0, 5.0, -depth);
    for (const double speed : {0.3, 1.4}) {
      Walk w(m, {}, Mode::walk, {0.5, 0.0, 0.95});
      w.go({speed, 0.0, 0.0}, 1.5 / speed);
      SCOPED_TRACE(testing::Message() << "speed " << speed << ", ledge " << depth);
      EXPECT_NEAR(w.feet(), -depth, near_ground);
      EXPECT_EQ(w.count(EventKind::stepped_down), depth < 0.3 ? 1 : 0);
      EXPECT_EQ(w.count(EventKind::airborne), depth < 0.3 ? 0 : 1);
    }
  }
}

TEST(Ground, ABigBallDoesNotRollUpAKerbThatIsTooHighToStepOnto) {
  for (const double speed : {0.2, 1.4, 10.0}) {
    Mesh m = floor_mesh();
    add_wall(m, 2.0, -5.0, 2.0, 5.0, 0.0, 0.45);
    add_floor(m, 2.0, -5.0, 15.0, 5.0, 0.45);
    Walk w(m, {.radius = 0.7, .height = 1.4, .eye = 1.0}, Mode::walk, {0.5, 0.0, 0.71});
    w.go({speed, 0.0, 0.0}, 3.0 / speed);
    EXPECT_LT(w.walker.position().x, 2.0) << speed;
    EXPECT_LT(w.feet(), 0.1) << speed;
  }
}

Mesh ramp(double degrees) {
  Mesh m = floor_mesh();
  const double rise = 6.0 * std::tan(degrees * std::numbers::pi / 180.0);
  add_quad(m, {1.0, -3.0, 0.0}, {7.0, -3.0, rise}, {7.0, 3.0, rise}, {1.0, 3.0, 0.0});
  return m;
}

TEST(Ground, ClimbsARampJustBelowTheSlopeLimit) {
  const Mesh m = ramp(44.0);
  Walk w(m, {}, Mode::walk, {0.0, 0.0, 0.95});
  w.go({1.4, 0.0, 0.0}, 3.0);
  EXPECT_NEAR(w.walker.position().x, 4.2, 0.02);
  EXPECT_GT(w.feet(), 2.5);
  EXPECT_EQ(w.count(EventKind::airborne), 0);
  const Vec3 rest = w.walker.position();
  w.go({0.0, 0.0, 0.0}, 1.0);
  EXPECT_EQ(w.walker.position(), rest);
  w.go({-1.4, 0.0, 0.0}, 3.0);
  EXPECT_EQ(w.count(EventKind::airborne), 0);
  EXPECT_LT(w.feet(), near_ground);
}

TEST(Ground, KeepsTheSkinOnASlope) {
  const Mesh m = ramp(40.0);
  Walk w(m, {}, Mode::walk, {1.5, 0.0, 1.6});
  w.go(Vec3(0.0), 1.0);
  const double skin = w.walker.skin();
  for (const double speed : {1.4, -1.4}) {
    for (int i = 0; i < 90; ++i) {
      w.step({speed, 0.0, 0.0});
      const double gap = w.world.clearance(w.walker.body(), w.walker.position(), 1.0).distance;
      ASSERT_NEAR(gap, skin, 0.3 * skin) << speed << " at " << i;
    }
  }
}

TEST(Ground, LiftsABodyPutNearASlopeToItsSkin) {
  const World world = build(ramp(44.0), true);
  const double angle = 44.0 * std::numbers::pi / 180.0;
  const Vec3 away(-std::sin(angle), 0.0, std::cos(angle)), point(4.0, 0.0, 3.0 * std::tan(angle));
  const Walker w(world, {}, Mode::walk, point + away * (0.3 + 1e-5) + Vec3(0.0, 0.0, 0.6));
  EXPECT_NEAR(world.clearance(w.body(), w.position(), 1.0).distance, w.skin(), 0.3 * w.skin());
}

// Each side is too steep to stand on; both together carry. The body meets one of them first.
TEST(Ground, StaysInAGrooveThatFalls) {
  Mesh m;
  const double side = std::tan(60.0 * std::numbers::pi / 180.0);
  for (const double y : {-2.0, 2.0}) {
    add_quad(m, {-8.0, 0.0, 1.0}, {8.0, 0.0, -1.0}, {8.0, y, -1.0 + 2.0 * side}, {-8.0, y, 1.0 + 2.0 * side});
  }
  for (const double speed : {0.5, 1.4, 5.0}) {
    Walk w(m, {}, Mode::walk, {-5.0, 0.01, 2.5});
    w.go(Vec3(0.0), 1.0);
    ASSERT_TRUE(w.walker.grounded());
    const int airborne = w.count(EventKind::airborne);
    for (double t = 0.0; t < 12.0 / speed && w.walker.position().x < 5.0; t += frame) {
      w.step({speed, 0.0, 0.0});
      ASSERT_TRUE(w.walker.grounded()) << speed << " at " << w.walker.position().x;
    }
    EXPECT_GE(w.walker.position().x, 5.0) << speed;
    EXPECT_EQ(w.count(EventKind::airborne), airborne);
  }
}

TEST(Ground, DoesNotClimbARampJustAboveTheSlopeLimit) {
  const Mesh m = ramp(46.0);
  for (const double speed : {0.1, 1.4, 14.0}) {
    Walk w(m, {}, Mode::walk, {0.0, 0.0, 0.95});
    w.go({speed, 0.0, 0.0}, 3.0);
    EXPECT_LT(w.feet(), 0.1) << speed;
    EXPECT_LT(w.walker.position().x, 1.1) << speed;
  }
}

TEST(Ground, SlidesDownASlopeThatIsTooSteepToStandOn) {
  const Mesh m = ramp(60.0);
  Walk w(m, {}, Mode::walk, {4.0, 0.0, 6.5});
  w.go({0.0, 0.0, 0.0}, 6.0);
  EXPECT_TRUE(w.walker.grounded());
  EXPECT_LT(w.feet(), near_ground);
  EXPECT_LT(w.walker.position().x, 1.0);
}

struct FlatFloor {
  const char* name;
  int fields;
  Vec3 origin;
  bool lossless;
};

class FlatFloors : public testing::TestWithParam<FlatFloor> {};

TEST_P(FlatFloors, NeverCatchTheWalkerOnTheirInnerEdges) {
  Mesh m = rough_tiling(GetParam().fields, 7);
  shift(m, GetParam().origin);
  const World world = build(m, GetParam().lossless);
  Random random(3);
  for (int walk = 0; walk < 40; ++walk) {
    const double angle = random.between(0.0, 2.0 * std::numbers::pi);
    const Vec3 velocity(1.4 * std::cos(angle), 1.4 * std::sin(angle), 0.0);
    const Vec3 start = GetParam().origin + Vec3(random.between(-1.0, 1.0), random.between(-1.0, 1.0), 0.95);
    Walker w(world, {}, Mode::walk, start);
    double lowest = w.feet().z, highest = lowest;
    for (int i = 1; i <= 300; ++i) {
      const StepReport& r = w.step({velocity}, frame);
      ASSERT_FALSE(r.blocked);
      ASSERT_TRUE(r.grounded);
      ASSERT_TRUE(r.events.empty());
      lowest = std::min(lowest, w.feet().z);
      highest = std::max(highest, w.feet().z);
      ASSERT_NEAR(w.position().x, start.x + velocity.x * i * frame, 1e-6);
      ASSERT_NEAR(w.position().y, start.y + velocity.y * i * frame, 1e-6);
    }
    EXPECT_LT(highest - lowest, 0.004);
  }
}

// 60 fields are 10^4 triangles in one tile of the index; 150 are 6 10^4 in several, with seams between them.
INSTANTIATE_TEST_SUITE_P(Ground, FlatFloors,
                         testing::Values(FlatFloor{"OneTile", 60, Vec3(0.0), false},
                                         FlatFloor{"ManyTiles", 150, Vec3(0.0), false},
                                         FlatFloor{"Lossless", 150, Vec3(0.0), true},
                                         FlatFloor{"InTheDamGallery", 150, Vec3(-13739.0, 253.0, 182.0), false},
                                         FlatFloor{"At6400Kilometres", 150, Vec3(6.4e6, -6.4e6, 6.4e6), false}),
                         [](const testing::TestParamInfo<FlatFloor>& floor) { return std::string(floor.param.name); });

/// Two floors with a crack of `width` between them, 5 m deep.
Mesh split(double width) {
  Mesh m;
  const double half = 0.5 * width;
  add_floor(m, -10.0, -5.0, -half, 5.0, 0.0);
  add_floor(m, half, -5.0, 10.0, 5.0, 0.0);
  add_wall(m, -half, -5.0, -half, 5.0, -5.0, 0.0);
  add_wall(m, half, -5.0, half, 5.0, -5.0, 0.0);
  add_floor(m, -half, -5.0, half, 5.0, -5.0);
  return m;
}

TEST(Ground, ABallThatBridgesTheSplitCrossesItAndOneThatDoesNotFallsIn) {
  const Mesh m = split(1.25);
  for (const double speed : {0.4, 1.5, 7.0, 50.0}) {
    for (const double dt : {1.0 / 240.0, 1.0 / 60.0, 1.0 / 25.0}) {
      for (const double radius : {0.3, 0.5, 0.6, 0.62, 0.7, 0.8, 1.0}) {
        SCOPED_TRACE(testing::Message() << "radius " << radius << ", dt " << dt << ", speed " << speed);
        Walk w(m, ball(radius), Mode::walk, {-4.0, 0.0, radius + 0.05});
        double lowest = 0.0;
        for (double t = 0.0; t < 8.0 / speed; t += dt) {
          w.step({speed, 0.0, 0.0}, std::min(dt, 8.0 / speed - t));
          lowest = std::min(lowest, w.feet());
        }
        w.go({0.0, 0.0, 0.0}, 1.5);
        if (radius > 0.65) {
          EXPECT_GT(w.walker.position().x, 3.0);
          EXPECT_EQ(w.count(EventKind::fell), 0);
          // The lowest of the steps' ends, not of the way: it may miss the bottom by half a step.
          const double bottom = -(radius - std::sqrt(radius * radius - 0.625 * 0.625));
          EXPECT_GT(lowest, bottom - near_ground);
          if (speed < 2.0) {
            EXPECT_LT(lowest, bottom + 1.5 * dt);
          }
        } else {
          EXPECT_EQ(w.count(EventKind::fell), 1);
          EXPECT_LT(std::abs(w.walker.position().x), 0.625);
          EXPECT_NEAR(w.feet(), -5.0, near_ground);
        }
      }
    }
  }
}

TEST(Ground, APersonFallsIntoTheSplit) {
  const Mesh m = split(1.25);
  Walk w(m, {}, Mode::walk, {-2.0, 0.0, 0.95});
  w.go({1.5, 0.0, 0.0}, 4.0);
  EXPECT_EQ(w.count(EventKind::fell), 1);
}

TEST(Ground, StepsOverANarrowJointWithoutNoticing) {
  const Mesh m = split(0.05);
  Walk w(m, {}, Mode::walk, {-2.0, 0.0, 0.95});
  w.go({1.4, 0.0, 0.0}, 3.0);
  EXPECT_GT(w.walker.position().x, 2.0);
  EXPECT_EQ(w.count(EventKind::airborne), 0);
}

TEST(Ground, JumpsAsHighAsToldAndLands) {
  const Mesh m = floor_mesh();
  Walk w(m, {}, Mode::walk, {0.0, 0.0, 0.95});
  w.step({});
  double highest = 0.0;
  w.step({}, frame, true);
  for (int i = 0; i < 120; ++i) {
    w.step({});
    highest = std::max(highest, w.feet());
  }
  EXPECT_NEAR(highest, 0.5, 0.02);
  EXPECT_TRUE(w.walker.grounded());
  EXPECT_EQ(w.count(EventKind::jumped), 1);
  EXPECT_EQ(w.count(EventKind::landed), 1);
  EXPECT_EQ(w.count(EventKind::fell), 0);
}

TEST(Ground, BumpsItsHeadAndComesDown) {
  Mesh m = floor_mesh();
  add_floor(m, -5.0, -5.0, 5.0, 5.0, 1.9);
  Walk w(m, {}, Mode::walk, {0.0, 0.0, 0.95});
  w.step({});
  w.step({}, frame, true);
  double airborne = 0.0;
  for (int i = 0; i < 120 && !w.walker.grounded(); ++i, airborne += frame) w.step({});
  EXPECT_LT(airborne, 0.3);
  EXPECT_TRUE(w.walker.grounded());
}

}  // namespace
