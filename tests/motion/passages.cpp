#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "walker_judged.h"

namespace {

using namespace scenes;

Mesh doorway(double width) {
  Mesh m = floor_mesh();
  const double half = 0.5 * width;
  for (const double x : {1.0, 1.2}) {
    add_wall(m, x, -5.0, x, -half, 0.0, 2.5);
    add_wall(m, x, half, x, 5.0, 0.0, 2.5);
  }
  add_wall(m, 1.0, -half, 1.2, -half, 0.0, 2.5);
  add_wall(m, 1.0, half, 1.2, half, 0.0, 2.5);
  return m;
}

TEST(Passages, PassesADoorwayOf688MillimetresWithABodyOf640) {
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    for (const double y : {0.0, 0.01, -0.02, 0.15, -0.3}) {
      const Mesh m = doorway(0.688);
      Walk w(m, {.radius = 0.32, .height = 1.8}, mode, {-1.0, y, 0.95});
      for (int i = 0; i < 600 && w.walker.position().x < 2.0; ++i) {
        const Vec3 to_door = Vec3(3.0, 0.0, 0.95) - w.walker.position();
        w.step(to_door * (1.4 / std::sqrt(to_door.x * to_door.x + to_door.y * to_door.y)));
      }
      EXPECT_GE(w.walker.position().x, 2.0) << y;
    }
  }
}

TEST(Passages, DoesNotCrouchWhereNothingIsLow) {
  const Mesh m = doorway(0.688);
  for (const double speed : {0.1, 0.5, 1.4, 3.0, 7.0}) {
    for (const double y : {-0.3, -0.285, -0.15, -0.0239, 0.02, 0.1, 0.27}) {
      for (const bool straight : {false, true}) {
        SCOPED_TRACE(testing::Message() << speed << " m/s from " << y << (straight ? " straight on" : ""));
        Walk w(m, {.radius = 0.32, .height = 1.8}, Mode::walk, {0.3, y, 0.95});
        for (int i = 0; i < 1200 && w.walker.position().x < 2.0; ++i) {
          Vec3 way = straight ? Vec3(1.0, 0.0, 0.0) : Vec3(3.0, 0.0, 0.0) - w.walker.position();
          way.z = 0.0;
          w.step(way * (speed / std::sqrt(way.x * way.x + way.y * way.y)));
          ASSERT_FALSE(w.walker.crouched()) << w.walker.position().x;
        }
        EXPECT_EQ(w.count(EventKind::crouched), 0);
        EXPECT_GE(w.walker.position().x, speed < 0.2 ? 1.2 : 2.0);
      }
    }
  }
}

TEST(Passages, CrouchesUnderALowCeilingHoweverSlow) {
  const Mesh m = low_passage(1.2);
  for (const double speed : {0.03, 0.3, 5.0}) {
    Walk w(m, {}, Mode::walk, {0.69, 0.0, 0.95});
    w.go({speed, 0.0, 0.0}, std::min(1.0, 1.5 / speed));
    EXPECT_TRUE(w.walker.crouched()) << speed;
  }
}

TEST(Passages, PassesADoorwayTwoMillimetresWiderThanItself) {
  for (const double y : {0.0, 0.0005, 0.003, -0.02}) {
    const Mesh m = doorway(0.642);
    Walk w(m, {.radius = 0.32, .height = 1.8}, Mode::walk, {-1.0, y, 0.95});
    for (int i = 0; i < 300 && w.walker.position().x < 2.0; ++i) {
      const Vec3 to_door(3.0 - w.walker.position().x, -w.walker.position().y, 0.0);
      w.step(to_door * (1.4 / std::sqrt(to_door.x * to_door.x + to_door.y * to_door.y)));
    }
    EXPECT_GE(w.walker.position().x, 2.0) << y;
  }
}

TEST(Passages, DoesNotPassADoorwayThatIsNarrowerThanItself) {
  const Mesh m = doorway(0.638);
  Walk w(m, {.radius = 0.32, .height = 1.8}, Mode::walk, {-1.0, 0.001, 0.95});
  w.go({1.4, 0.0, 0.0}, 3.0);
  EXPECT_LT(w.walker.position().x, 1.0);
  EXPECT_TRUE(w.walker.report().blocked);
}

TEST(Passages, CrouchesUnderALowCeilingAndStandsUpOnlyWhereThereIsHeadRoom) {
  const Mesh m = low_passage(1.2);
  Walk w(m, {}, Mode::walk, {0.0, 0.0, 0.95});
  bool crouched_below = false;
  for (int i = 0; i < 300; ++i) {
    w.step({1.4, 0.0, 0.0});
    const double x = w.walker.position().x;
    if (x > 0.9 && x < 4.1) {
      EXPECT_TRUE(w.walker.crouched()) << x;
      crouched_below = true;
    }
  }
  EXPECT_TRUE(crouched_below);
  EXPECT_FALSE(w.walker.crouched());
  EXPECT_GT(w.walker.position().x, 6.0);
  EXPECT_EQ(w.count(EventKind::crouched), 1);
  EXPECT_EQ(w.count(EventKind::stood), 1);
  EXPECT_NEAR(w.feet(), 0.0, near_ground);
}

TEST(Passages, IsBlockedByACeilingLowerThanItCrouches) {
  const Mesh m = low_passage(1.05);
  Walk w(m, {}, Mode::walk, {0.0, 0.0, 0.95});
  w.go({1.4, 0.0, 0.0}, 3.0);
  EXPECT_LT(w.walker.position().x, 1.0);
  EXPECT_TRUE(w.walker.report().blocked);
}

TEST(Passages, CrouchesWhenToldAndStaysSo) {
  const Mesh m = floor_mesh();
  Walk w(m, {}, Mode::walk, {0.0, 0.0, 0.95});
  w.step({}, frame, false, true);
  EXPECT_TRUE(w.walker.crouched());
  EXPECT_NEAR(w.walker.eye().z, 1.6 * 1.1 / 1.8, near_ground);
  w.step({}, frame, false, true);
  EXPECT_TRUE(w.walker.crouched());
  w.step({});
  EXPECT_FALSE(w.walker.crouched());
  EXPECT_NEAR(w.walker.eye().z, 1.6, near_ground);
}

}  // namespace
