#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "walker_judged.h"

namespace {

using namespace scenes;

Mesh thin_doorway(double width) {
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
      const Mesh m = thin_doorway(0.688);
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
  const Mesh m = thin_doorway(0.688);
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

/// Vertices off the grid, so that the world has an error and the walker a skin of more than a millimetre.
TEST(Passages, CrouchesUnderALowCeilingByStepsShorterThanItsSkin) {
  const struct {
    double speed, acceleration, dt, start;
  } ways[] = {{1.4, 9.33, 1.0 / 240.0, -0.305},
              {1.4, 2.0, 1.0 / 144.0, -0.31},
              {0.2, INFINITY, 1.0 / 240.0, -0.31},
              {1.4, INFINITY, 1e-4, -0.304}};
  for (const double rise : {0.0, 0.36, -0.36})
    for (const auto& way : ways) {
      SCOPED_TRACE(testing::Message() << "rise " << rise << ", " << way.speed << " m/s, " << way.dt << " s");
      const auto at = [&](double x, double y, double z) { return Vec3(x, y, z + rise * x); };
      Mesh m;
      add_quad(m, at(-200.3, -200.7, 0.0003), at(200.1, -200.7, 0.0003), at(200.1, 200.9, 0.0003),
               at(-200.3, 200.9, 0.0003));
      add_quad(m, at(0.0003, -8.0, 1.5003), at(4.0, -8.0, 1.5003), at(4.0, 8.0, 1.5003), at(0.0003, 8.0, 1.5003));
      add_quad(m, at(0.0003, -8.0, 1.5003), at(0.0003, 8.0, 1.5003), at(0.0003, 8.0, 4.0), at(0.0003, -8.0, 4.0));
      Walk w(m, {}, Mode::walk, at(way.start, 0.0, 0.91 + 0.3 * (std::sqrt(1.0 + rise * rise) - 1.0)));
      ASSERT_GT(w.world.largest_error(), 2e-4);
      const int steps = static_cast<int>(1.0 / way.dt);
      for (int i = 0; i < steps && w.walker.position().x < 0.0; ++i) {
        const StepReport& r = w.walker.step(
            {.velocity = {way.speed, 0.0, 0.0}, .acceleration = way.acceleration, .braking = 2.0 * way.acceleration},
            way.dt);
        ASSERT_GE(margin(w.judge, r, w.walker.settings().radius), 0.0);
      }
      EXPECT_TRUE(w.walker.crouched());
      EXPECT_GT(w.walker.position().x, way.start + 0.1);
    }
}

/// The ground is higher ahead because it rises, not because the body is over the wall.
TEST(Passages, SlidesAlongALowWallUpASlopeWithoutSteps) {
  for (const double degrees : {5.0, 28.0, 40.0}) {
    const double rise = std::tan(degrees * std::numbers::pi / 180.0);
    for (const double top : {0.25, 0.35, 0.6, 0.65, 0.7, 0.8, 1.0}) {
      Mesh m;
      add_quad(m, {-5.0, -5.0, -5.0 * rise}, {5.0, -5.0, -5.0 * rise}, {5.0, 5.0, 5.0 * rise}, {-5.0, 5.0, 5.0 * rise});
      // Its top is level, so that in the end the body may step onto it.
      add_box(m, {0.0, -5.0, -6.0}, {0.1, 5.0, top});
      Walk w(m, {}, Mode::walk, {-0.301, 0.0, 0.95 + 0.3 * (1.0 / std::cos(degrees * std::numbers::pi / 180.0) - 1.0)});
      for (int i = 0; i < 40; ++i) {
        const StepReport& r = w.step({1.4 * std::sin(0.057), 1.4 * std::cos(0.057), 0.0});
        const auto steps = std::count_if(r.events.begin(), r.events.end(),
                                         [](const roam::Event& e) { return e.kind == EventKind::stepped_up; });
        ASSERT_LE(steps, 1) << degrees << " degrees, " << top << " m, step " << i;
      }
      EXPECT_GT(w.walker.position().y, 0.5) << degrees << " degrees, " << top << " m";
    }
  }
}

TEST(Passages, PassesADoorwayTwoMillimetresWiderThanItself) {
  for (const double y : {0.0, 0.0005, 0.003, -0.02}) {
    const Mesh m = thin_doorway(0.642);
    Walk w(m, {.radius = 0.32, .height = 1.8}, Mode::walk, {-1.0, y, 0.95});
    for (int i = 0; i < 300 && w.walker.position().x < 2.0; ++i) {
      const Vec3 to_door(3.0 - w.walker.position().x, -w.walker.position().y, 0.0);
      w.step(to_door * (1.4 / std::sqrt(to_door.x * to_door.x + to_door.y * to_door.y)));
    }
    EXPECT_GE(w.walker.position().x, 2.0) << y;
  }
}

TEST(Passages, DoesNotPassADoorwayThatIsNarrowerThanItself) {
  const Mesh m = thin_doorway(0.638);
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

/// Two walls along x whose facets turn to and fro, 1 m apart.
Mesh folded_walls() {
  Mesh m;
  constexpr double fold = 0.05, length = 0.1;
  for (int i = -10; i < 400; ++i) {
    const double from = i % 2 == 0 ? 0.0 : fold, x = length * i;
    for (const double side : {-1.0, 1.0}) {
      add_wall(m, x, side * (0.5 + from), x + length, side * (0.5 + fold - from), -60.0, 60.0);
    }
  }
  return m;
}

TEST(Passages, AStepAlongManyFoldsEndsWhereItsReportIsFull) {
  const Mesh m = folded_walls();
  for (const Mode mode : {Mode::fly, Mode::walk}) {  // the walker falls
    for (const double across : {0.0, 3.0, 20.0, -60.0}) {
      Walk w(m, ball(0.45), mode, {0.0, 0.0, 0.0});
      // Beside a region a body flies by short slides.
      const roam::SizeRegion region{{Vec3(-100.0), Vec3(100.0)}, 0.45, 0.0, ""};
      w.walker.set_regions({&region, 1});
      double time = 0.0;
      bool throttled = false;
      for (int i = 0; i < 4; ++i) {
        const StepReport& r = w.step({60.0, across, 0.0}, 0.5);
        EXPECT_TRUE(r.elapsed == 0.5 || r.has(EventKind::throttled)) << r.elapsed;
        throttled = throttled || r.has(EventKind::throttled);
        time += r.elapsed;
        // The next step goes on with the speed of this one.
        EXPECT_NEAR(r.to.z, mode == Mode::walk ? -0.5 * 9.81 * time * time : 0.0, 0.01);
      }
      EXPECT_EQ(throttled, across != 0.0 && (mode == Mode::fly || across != 3.0));
    }
  }
}

}  // namespace
