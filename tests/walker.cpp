#include "roam/walker.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "roam/error.h"
#include "roam/route.h"
#include "walker_scenes.h"

namespace {

using roam::EventKind;
using roam::Mesh;
using roam::Mode;
using roam::StepReport;
using roam::Vec3;
using roam::Walker;
using roam::WalkerSettings;
using roam::World;

constexpr double frame = 1.0 / 60.0;

/// Walks and checks every step against brute force.
struct Walk {
  const Mesh& mesh;
  World world;
  scenes::Judge judge;
  Walker walker;
  int events[32] = {};

  Walk(const Mesh& scene, const WalkerSettings& settings, Mode mode, const Vec3& start)
      : mesh(scene), world(scenes::build(scene)), judge(scene), walker(world, settings, mode, start) {
    EXPECT_GE(scenes::margin(judge, walker.report(), settings.radius), 0.0);
  }

  const StepReport& step(const Vec3& velocity, double dt = frame, bool jump = false, bool crouch = false) {
    const StepReport& r = walker.step({velocity, jump, crouch}, dt);
    EXPECT_GE(scenes::margin(judge, r, walker.settings().radius), 0.0);
    for (const roam::Event& e : r.events) ++events[static_cast<int>(e.kind)];
    return r;
  }
  void go(const Vec3& velocity, double seconds, double dt = frame) {
    for (double t = 0.0; t < seconds - 0.5 * dt; t += dt) step(velocity, dt);
  }
  [[nodiscard]] int count(EventKind kind) const { return events[static_cast<int>(kind)]; }
  [[nodiscard]] double feet() const { return walker.feet().z; }
};

/// A floor of 40 m by 20 m at height 0 with its middle at the origin.
Mesh floor_mesh() {
  Mesh m;
  scenes::add_floor(m, -20.0, -10.0, 20.0, 10.0, 0.0);
  return m;
}

constexpr double near_ground = 0.01;  // metres: skin and storage error

TEST(Walker, StandsOnTheFloorWithoutMoving) {
  const Mesh m = floor_mesh();
  Walk w(m, {}, Mode::walk, {0.0, 0.0, 1.0});
  w.go({0.0, 0.0, 0.0}, 0.1);
  const Vec3 rest = w.walker.position();
  EXPECT_TRUE(w.walker.grounded());
  EXPECT_LT(w.feet(), near_ground);
  w.go({0.0, 0.0, 0.0}, 5.0);
  EXPECT_EQ(w.walker.position(), rest);
}

TEST(Walker, WalksAtTheWishedSpeedOverFlatGround) {
  const Mesh m = floor_mesh();
  Walk w(m, {}, Mode::walk, {-5.0, 0.0, 0.95});
  w.go({1.4, 0.0, 0.0}, 5.0);
  EXPECT_NEAR(w.walker.position().x, 2.0, 1e-9);
  EXPECT_EQ(w.count(EventKind::airborne), 0);
}

TEST(Walker, SlidesAlongAWallItWalksIntoAtAnAngle) {
  Mesh m = floor_mesh();
  scenes::add_wall(m, 2.0, -10.0, 2.0, 10.0, 0.0, 3.0);
  Walk w(m, {}, Mode::walk, {0.0, 0.0, 0.95});
  w.go({1.0, 1.0, 0.0}, 5.0);
  EXPECT_NEAR(w.walker.position().x, 1.7, near_ground);
  EXPECT_NEAR(w.walker.position().y, 5.0, 0.02);
  EXPECT_GT(w.count(EventKind::slid), 0);
}

TEST(Walker, ClimbsStairsAndComesDownAgain) {
  Mesh m = floor_mesh();
  for (int i = 0; i < 10; ++i) {
    const double x = 1.0 + 0.28 * i, z = 0.17 * i;
    scenes::add_wall(m, x, -2.0, x, 2.0, z, z + 0.17);
    scenes::add_floor(m, x, -2.0, i == 9 ? 12.0 : x + 0.28, 2.0, z + 0.17);
  }
  Walk w(m, {}, Mode::walk, {-1.0, 0.0, 0.95});
  w.go({1.4, 0.0, 0.0}, 6.0);
  EXPECT_NEAR(w.feet(), 1.7, near_ground);
  EXPECT_NEAR(w.walker.position().x, -1.0 + 8.4, 0.3);
  EXPECT_GE(w.count(EventKind::stepped_up), 5);
  EXPECT_EQ(w.count(EventKind::airborne), 0);
  w.go({-1.4, 0.0, 0.0}, 6.0);
  EXPECT_NEAR(w.feet(), 0.0, near_ground);
  EXPECT_EQ(w.count(EventKind::airborne), 0);
  EXPECT_EQ(w.count(EventKind::fell), 0);
}

TEST(Walker, StepsOntoAKerbOfStepHeightAtAnySpeedButNotOntoAHigherOne) {
  for (const double speed : {0.05, 0.5, 1.4, 7.0}) {
    for (const double height : {0.05, 0.15, 0.29, 0.31, 0.5}) {
      Mesh m = floor_mesh();
      scenes::add_wall(m, 1.0, -2.0, 1.0, 2.0, 0.0, height);
      scenes::add_floor(m, 1.0, -2.0, 15.0, 2.0, height);
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

TEST(Walker, ABigBallDoesNotRollUpAKerbThatIsTooHighToStepOnto) {
  for (const double speed : {0.2, 1.4, 10.0}) {
    Mesh m = floor_mesh();
    scenes::add_wall(m, 2.0, -5.0, 2.0, 5.0, 0.0, 0.45);
    scenes::add_floor(m, 2.0, -5.0, 15.0, 5.0, 0.45);
    Walk w(m, {.radius = 0.7, .height = 1.4, .eye = 1.0}, Mode::walk, {0.5, 0.0, 0.71});
    w.go({speed, 0.0, 0.0}, 3.0 / speed);
    EXPECT_LT(w.walker.position().x, 2.0) << speed;
    EXPECT_LT(w.feet(), 0.1) << speed;
  }
}

Mesh ramp(double degrees) {
  Mesh m = floor_mesh();
  const double rise = 6.0 * std::tan(degrees * std::numbers::pi / 180.0);
  scenes::add_quad(m, {1.0, -3.0, 0.0}, {7.0, -3.0, rise}, {7.0, 3.0, rise}, {1.0, 3.0, 0.0});
  return m;
}

TEST(Walker, ClimbsARampJustBelowTheSlopeLimit) {
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

TEST(Walker, DoesNotClimbARampJustAboveTheSlopeLimit) {
  const Mesh m = ramp(46.0);
  for (const double speed : {0.1, 1.4, 14.0}) {
    Walk w(m, {}, Mode::walk, {0.0, 0.0, 0.95});
    w.go({speed, 0.0, 0.0}, 3.0);
    EXPECT_LT(w.feet(), 0.1) << speed;
    EXPECT_LT(w.walker.position().x, 1.1) << speed;
  }
}

TEST(Walker, SlidesDownASlopeThatIsTooSteepToStandOn) {
  const Mesh m = ramp(60.0);
  Walk w(m, {}, Mode::walk, {4.0, 0.0, 6.5});
  w.go({0.0, 0.0, 0.0}, 6.0);
  EXPECT_TRUE(w.walker.grounded());
  EXPECT_LT(w.feet(), near_ground);
  EXPECT_LT(w.walker.position().x, 1.0);
}

Mesh corner(double degrees) {
  Mesh m = floor_mesh();
  const double a = 0.5 * degrees * std::numbers::pi / 180.0, c = 4.0 * std::cos(a), s = 4.0 * std::sin(a);
  scenes::add_wall(m, 2.0, 0.0, 2.0 - c, s, 0.0, 3.0);
  scenes::add_wall(m, 2.0, 0.0, 2.0 - c, -s, 0.0, 3.0);
  return m;
}

TEST(Walker, StandsStillInACornerWhilePushing) {
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    for (const double degrees : {150.0, 90.0, 60.0, 30.0}) {
      for (const double y : {0.0, 0.2, -0.7}) {
        const Mesh m = corner(degrees);
        Walk w(m, {}, mode, {-0.5, 0.0, 0.95});
        w.go({1.4, y, 0.0}, 4.0);
        const Vec3 rest = w.walker.position();
        if (std::abs(y) > 0.3 && degrees > 100.0) continue;  // slides out along one wall
        for (int i = 0; i < 300; ++i) {
          w.step({1.4, y, 0.0});
          ASSERT_EQ(w.walker.position(), rest) << degrees << " degrees, step " << i;
          ASSERT_TRUE(w.walker.report().blocked);
        }
      }
    }
  }
}

TEST(Walker, FollowsTheCreaseOfTwoWallsWhenFlying) {
  Mesh m;
  scenes::add_quad(m, {2.0, -10.0, -10.0}, {2.0, 10.0, -10.0}, {2.0, 10.0, 10.0}, {2.0, -10.0, 10.0});
  scenes::add_quad(m, {-10.0, 2.0, -10.0}, {10.0, 2.0, -10.0}, {10.0, 2.0, 10.0}, {-10.0, 2.0, 10.0});
  Walk w(m, {}, Mode::fly, {0.0, 0.0, -5.0});
  w.go({1.0, 1.0, 1.0}, 6.0);
  EXPECT_NEAR(w.walker.position().x, 1.7, near_ground);
  EXPECT_NEAR(w.walker.position().y, 1.7, near_ground);
  EXPECT_NEAR(w.walker.position().z, 1.0, 0.05);
}

TEST(Walker, StopsWhereThreeWallsMeet) {
  Mesh m;
  scenes::add_box(m, {-3.0, -3.0, -3.0}, {3.0, 3.0, 3.0});
  Walk w(m, {}, Mode::fly, {0.0, 0.0, 0.0});
  w.go({5.0, 4.0, 3.0}, 3.0);
  const Vec3 rest = w.walker.position();
  EXPECT_NEAR(rest.x, 2.7, near_ground);
  EXPECT_NEAR(rest.y, 2.7, near_ground);
  EXPECT_NEAR(rest.z, 2.1, near_ground);
  w.go({5.0, 4.0, 3.0}, 1.0);
  EXPECT_EQ(w.walker.position(), rest);
}

/// About 2.7 n^2 triangles that cover 20 m by 20 m at height 0: random diagonals, and vertices in the middle of edges.
Mesh rough_tiling(int n, std::uint64_t seed) {
  scenes::Random random(seed);
  Mesh m;
  const double size = 20.0 / n;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = -10.0 + i * size, y = -10.0 + j * size;
      const Vec3 a(x, y, 0.0), b(x + size, y, 0.0), c(x + size, y + size, 0.0), d(x, y + size, 0.0);
      const double pick = random.unit();
      if (pick < 0.3) {
        scenes::add_quad(m, a, b, c, d);
      } else if (pick < 0.6) {
        scenes::add_quad(m, b, c, d, a);
      } else {  // a fan round a point on one edge: a T-junction with the neighbour
        const Vec3 e = a + (b - a) * random.between(0.02, 0.98);
        scenes::add_triangle(m, a, e, d);
        scenes::add_triangle(m, e, c, d);
        scenes::add_triangle(m, e, b, c);
        if (random.chance(0.5)) scenes::add_triangle(m, e, b, e + (c - e) * random.between(0.01, 0.1));
      }
    }
  }
  return m;
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
  scenes::shift(m, GetParam().origin);
  const World world = scenes::build(m, GetParam().lossless);
  scenes::Random random(3);
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
INSTANTIATE_TEST_SUITE_P(Walker, FlatFloors,
                         testing::Values(FlatFloor{"OneTile", 60, Vec3(0.0), false},
                                         FlatFloor{"ManyTiles", 150, Vec3(0.0), false},
                                         FlatFloor{"Lossless", 150, Vec3(0.0), true},
                                         FlatFloor{"InTheDamGallery", 150, Vec3(-13739.0, 253.0, 182.0), false},
                                         FlatFloor{"At6400Kilometres", 150, Vec3(6.4e6, -6.4e6, 6.4e6), false}),
                         [](const testing::TestParamInfo<FlatFloor>& floor) { return std::string(floor.param.name); });

Mesh doorway(double width) {
  Mesh m = floor_mesh();
  const double half = 0.5 * width;
  for (const double x : {1.0, 1.2}) {
    scenes::add_wall(m, x, -5.0, x, -half, 0.0, 2.5);
    scenes::add_wall(m, x, half, x, 5.0, 0.0, 2.5);
  }
  scenes::add_wall(m, 1.0, -half, 1.2, -half, 0.0, 2.5);
  scenes::add_wall(m, 1.0, half, 1.2, half, 0.0, 2.5);
  return m;
}

TEST(Walker, PassesADoorwayOf688MillimetresWithABodyOf640) {
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

TEST(Walker, StartsExactlyInTouchWithTheFloorWithoutAWord) {
  const Mesh m = floor_mesh();
  Walk w(m, {}, Mode::walk, {0.0, 0.0, 0.9});
  EXPECT_EQ(w.walker.report().events.size(), 1u);
  EXPECT_TRUE(w.walker.report().has(EventKind::placed));
  EXPECT_TRUE(w.walker.grounded());
}

TEST(Walker, PassesADoorwayThatIsOnlyMillimetresWiderThanItself) {
  const Mesh m = doorway(0.65);
  Walk w(m, {.radius = 0.32, .height = 1.8}, Mode::walk, {-1.0, 0.001, 0.95});
  w.go({1.4, 0.0, 0.0}, 3.0);
  EXPECT_GE(w.walker.position().x, 2.0);
}

TEST(Walker, DoesNotPassADoorwayThatIsNarrowerThanItself) {
  const Mesh m = doorway(0.638);
  Walk w(m, {.radius = 0.32, .height = 1.8}, Mode::walk, {-1.0, 0.001, 0.95});
  w.go({1.4, 0.0, 0.0}, 3.0);
  EXPECT_LT(w.walker.position().x, 1.0);
  EXPECT_TRUE(w.walker.report().blocked);
}

/// A slab with its lower side at `height`, from x = 1 to x = 4.
Mesh low_passage(double height) {
  Mesh m = floor_mesh();
  scenes::add_box(m, {1.0, -8.0, height}, {4.0, 8.0, height + 0.4});
  return m;
}

TEST(Walker, CrouchesUnderALowCeilingAndStandsUpOnlyWhereThereIsHeadRoom) {
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

TEST(Walker, IsBlockedByACeilingLowerThanItCrouches) {
  const Mesh m = low_passage(1.05);
  Walk w(m, {}, Mode::walk, {0.0, 0.0, 0.95});
  w.go({1.4, 0.0, 0.0}, 3.0);
  EXPECT_LT(w.walker.position().x, 1.0);
  EXPECT_TRUE(w.walker.report().blocked);
}

TEST(Walker, CrouchesWhenToldAndStaysSo) {
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

/// Two floors with a crack of `width` between them, 5 m deep.
Mesh split(double width) {
  Mesh m;
  const double half = 0.5 * width;
  scenes::add_floor(m, -10.0, -5.0, -half, 5.0, 0.0);
  scenes::add_floor(m, half, -5.0, 10.0, 5.0, 0.0);
  scenes::add_wall(m, -half, -5.0, -half, 5.0, -5.0, 0.0);
  scenes::add_wall(m, half, -5.0, half, 5.0, -5.0, 0.0);
  scenes::add_floor(m, -half, -5.0, half, 5.0, -5.0);
  return m;
}

WalkerSettings ball(double radius) { return {.radius = radius, .height = 2.0 * radius, .eye = radius}; }

TEST(Walker, ABallThatBridgesTheSplitCrossesItAndOneThatDoesNotFallsIn) {
  const Mesh m = split(1.25);
  for (const double dt : {1.0 / 240.0, 1.0 / 60.0, 1.0 / 25.0}) {
    for (const double radius : {0.3, 0.5, 0.6, 0.62, 0.7, 0.8, 1.0}) {
      SCOPED_TRACE(testing::Message() << "radius " << radius << ", dt " << dt);
      Walk w(m, ball(radius), Mode::walk, {-4.0, 0.0, radius + 0.05});
      double lowest = 0.0;
      for (double t = 0.0; t < 6.0; t += dt) {
        w.step({1.5, 0.0, 0.0}, dt);
        lowest = std::min(lowest, w.feet());
      }
      if (radius > 0.65) {
        EXPECT_GT(w.walker.position().x, 3.0);
        EXPECT_EQ(w.count(EventKind::fell), 0);
        // The lowest of the steps' ends, not of the way: it may miss the bottom by half a step.
        const double bottom = -(radius - std::sqrt(radius * radius - 0.625 * 0.625));
        EXPECT_GT(lowest, bottom - near_ground);
        EXPECT_LT(lowest, bottom + 1.5 * dt);
      } else {
        EXPECT_EQ(w.count(EventKind::fell), 1);
        EXPECT_LT(std::abs(w.walker.position().x), 0.625);
        EXPECT_NEAR(w.feet(), -5.0, near_ground);
      }
    }
  }
}

TEST(Walker, APersonFallsIntoTheSplit) {
  const Mesh m = split(1.25);
  Walk w(m, {}, Mode::walk, {-2.0, 0.0, 0.95});
  w.go({1.5, 0.0, 0.0}, 4.0);
  EXPECT_EQ(w.count(EventKind::fell), 1);
}

TEST(Walker, StepsOverANarrowJointWithoutNoticing) {
  const Mesh m = split(0.05);
  Walk w(m, {}, Mode::walk, {-2.0, 0.0, 0.95});
  w.go({1.4, 0.0, 0.0}, 3.0);
  EXPECT_GT(w.walker.position().x, 2.0);
  EXPECT_EQ(w.count(EventKind::airborne), 0);
}

TEST(Walker, JumpsAsHighAsToldAndLands) {
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

TEST(Walker, BumpsItsHeadAndComesDown) {
  Mesh m = floor_mesh();
  scenes::add_floor(m, -5.0, -5.0, 5.0, 5.0, 1.9);
  Walk w(m, {}, Mode::walk, {0.0, 0.0, 0.95});
  w.step({});
  w.step({}, frame, true);
  double airborne = 0.0;
  for (int i = 0; i < 120 && !w.walker.grounded(); ++i, airborne += frame) w.step({});
  EXPECT_LT(airborne, 0.3);
  EXPECT_TRUE(w.walker.grounded());
}

TEST(Walker, AnEmbeddedStartIsFreedByAShortWay) {
  Mesh m = floor_mesh();
  scenes::add_wall(m, 2.0, -10.0, 2.0, 10.0, 0.0, 3.0);
  const World world = scenes::build(m);
  const scenes::Judge judge(m);
  Walker w(world, {}, Mode::walk, {1.85, 0.0, 0.85});
  EXPECT_TRUE(w.report().has(EventKind::freed));
  EXPECT_FALSE(w.held());
  EXPECT_GE(judge.distance(w.body(), w.position(), 1.0), 0.3 - 1e-6);
  EXPECT_LT(w.position().x, 2.0);  // on its side of the wall
  EXPECT_NEAR(w.position().x, 1.7, 0.01);
  EXPECT_NEAR(w.position().z, 0.9, 0.01);
}

TEST(Walker, AStartInTheMiddleOfAWallIsHeldAndSaidAndAGhostGetsOut) {
  Mesh m = floor_mesh();
  scenes::add_wall(m, 2.0, -10.0, 2.0, 10.0, 0.0, 3.0);
  const World world = scenes::build(m);
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

TEST(Walker, AStartTooNarrowForAnyWayOutIsHeld) {
  Mesh m;
  scenes::add_box(m, {-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2});
  const World world = scenes::build(m);
  Walker w(world, ball(0.3), Mode::fly, {0.0, 0.0, 0.0});
  EXPECT_TRUE(w.held());
}

TEST(Walker, AStartUnderALowCeilingCrouches) {
  const Mesh m = low_passage(1.2);
  Walk w(m, {}, Mode::walk, {2.5, 0.0, 0.92});
  EXPECT_TRUE(w.walker.crouched());
  EXPECT_FALSE(w.walker.held());
  w.go({1.4, 0.0, 0.0}, 3.0);
  EXPECT_FALSE(w.walker.crouched());
}

TEST(Walker, ABodyThatTouchesAWallWalksAwayFromIt) {
  for (const double gap : {0.0, 1e-9, 1e-6, 1e-4, -1e-5}) {
    Mesh m = floor_mesh();
    scenes::add_wall(m, 2.0, -10.0, 2.0, 10.0, 0.0, 3.0);
    const World world = scenes::build(m);
    Walker w(world, {}, Mode::walk, {1.7 - gap, 0.0, 0.9 + gap});
    for (int i = 0; i < 60; ++i) w.step({{-1.4, 0.3, 0.0}}, frame);
    EXPECT_NEAR(w.position().x, 0.3, 0.002) << gap;
    EXPECT_NEAR(w.position().y, 0.3, 0.002) << gap;
  }
}

TEST(Walker, WhereNothingIsBelowItIsPutBackToTheLastSafePlaceAndSaysSo) {
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

TEST(Walker, InAnEmptyWorldWalkingIsHeldAndFlyingIsFree) {
  const World world;
  Walker w(world, {}, Mode::walk, {1.0, 2.0, 3.0});
  w.step({{1.0, 0.0, 0.0}}, 1.0);
  EXPECT_TRUE(w.report().held);
  EXPECT_EQ(w.position(), Vec3(1.0, 2.0, 3.0));
  w.set_mode(Mode::fly);
  w.step({{1.0, 0.0, 0.0}}, 1.0);
  EXPECT_EQ(w.position(), Vec3(2.0, 2.0, 3.0));
}

TEST(Walker, AGhostPassesWallsAndReturnsToTheNearestSafePlace) {
  Mesh m = floor_mesh();
  scenes::add_wall(m, 2.0, -10.0, 2.0, 10.0, 0.0, 3.0);
  const World world = scenes::build(m);
  const scenes::Judge judge(m);
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

TEST(Walker, NeverPassesAThinWallAtAnySpeedAndTimeStep) {
  Mesh m = floor_mesh();
  scenes::add_box(m, {-6.0, -6.0, -0.5}, {6.0, 6.0, 4.0});
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    for (const double speed : {0.1, 1.4, 50.0, 3000.0, 1e7}) {
      for (const double dt : {1e-6, 1e-3, frame, 0.5, 10.0, 1e4}) {
        Walk w(m, {}, mode, {0.0, 0.0, 0.95});
        scenes::Random random(11);
        for (int i = 0; i < 10; ++i) {
          const double a = random.between(0.0, 2.0 * std::numbers::pi);
          const StepReport& r =
              w.step({speed * std::cos(a), speed * std::sin(a), speed * random.between(-0.2, 0.2)}, dt);
          ASSERT_LE(std::max(std::abs(r.to.x), std::abs(r.to.y)), 5.7) << speed << " m/s, " << dt << " s";
          ASSERT_LE(r.elapsed, dt);
          ASSERT_TRUE(r.elapsed == dt || r.has(EventKind::throttled));
        }
      }
    }
  }
}

TEST(Walker, ALongStepOverFlatGroundIsOnePiece) {
  const Mesh m = floor_mesh();
  Walk w(m, {}, Mode::walk, {-10.0, 0.0, 0.95});
  const StepReport& r = w.step({1.4, 0.0, 0.0}, 10.0);
  EXPECT_NEAR(w.walker.position().x, 4.0, 1e-6);
  EXPECT_LE(r.corners.size(), 3u);
  EXPECT_EQ(r.elapsed, 10.0);
}

TEST(Walker, AStepOfNoTimeDoesNothing) {
  const Mesh m = floor_mesh();
  Walk w(m, {}, Mode::walk, {0.0, 0.0, 0.95});
  const Vec3 before = w.walker.position();
  EXPECT_EQ(w.step({1.4, 0.0, 0.0}, 0.0).corners.size(), 0u);
  EXPECT_EQ(w.walker.position(), before);
}

TEST(Walker, GivesTheSameBitsOnEveryRun) {
  Mesh m = rough_tiling(60, 5);
  scenes::Random clutter(9);
  for (int i = 0; i < 30; ++i) {
    const Vec3 lo(clutter.between(-9.0, 9.0), clutter.between(-9.0, 9.0), 0.0);
    if (std::abs(lo.x) < 1.5 && std::abs(lo.y) < 1.5) continue;
    scenes::add_box(m, lo, lo + Vec3(clutter.between(0.1, 1.0), clutter.between(0.1, 1.0), clutter.between(0.1, 2.0)));
  }
  std::vector<Vec3> first;
  for (int run = 0; run < 2; ++run) {
    const World world = scenes::build(m);
    Walker w(world, {}, Mode::walk, {0.0, 0.0, 0.95});
    scenes::Random random(21);
    for (int i = 0; i < 2000; ++i) {
      const double a = random.between(0.0, 2.0 * std::numbers::pi);
      w.step({{2.0 * std::cos(a), 2.0 * std::sin(a), 0.0}, random.chance(0.02)}, random.between(0.0, 0.2));
      if (run == 0) {
        first.push_back(w.position());
      } else {
        ASSERT_EQ(std::memcmp(&first[i], &w.position(), sizeof(Vec3)), 0) << i;
      }
    }
  }
}

TEST(Walker, RefusesBadSettingsAndInputWithAReason) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const WalkerSettings& s, const std::string& word) {
    try {
      roam::check(s);
    } catch (const roam::Error& e) {
      return std::string(e.what()).find(word) != std::string::npos;
    }
    return false;
  };
  EXPECT_TRUE(refused({.radius = 0.0}, "radius"));
  EXPECT_TRUE(refused({.radius = -1.0}, "radius"));
  EXPECT_TRUE(refused({.radius = nan}, "radius"));
  EXPECT_TRUE(refused({.radius = 1.0}, "height"));
  EXPECT_TRUE(refused({.eye = 2.0}, "eye"));
  EXPECT_TRUE(refused({.step = -0.1}, "step"));
  EXPECT_TRUE(refused({.step = 1.0}, "step"));
  EXPECT_TRUE(refused({.slope_degrees = 90.0}, "slope"));
  EXPECT_TRUE(refused({.speed = 0.0}, "speed"));
  EXPECT_TRUE(refused({.fast_factor = 0.5}, "fast"));
  EXPECT_TRUE(refused({.gravity = -9.81}, "gravity"));
  EXPECT_TRUE(refused({.jump_height = nan}, "jump"));
  EXPECT_TRUE(refused({.crouch_height = 0.0}, "crouch"));
  EXPECT_TRUE(refused({.clearance_reach = 2000.0}, "reach"));
  EXPECT_NO_THROW(roam::check({}));
  EXPECT_NO_THROW(roam::check(ball(0.3)));

  const Mesh m = floor_mesh();
  const World world = scenes::build(m);
  EXPECT_THROW(Walker(world, {.radius = -1.0}, Mode::walk, Vec3(0.0)), roam::Error);
  EXPECT_THROW(Walker(world, {}, Mode::walk, Vec3(nan)), roam::Error);
  Walker w(world, {}, Mode::walk, {0.0, 0.0, 0.95});
  EXPECT_THROW(w.step({{nan, 0.0, 0.0}}, frame), roam::Error);
  EXPECT_THROW(w.step({}, -1.0), roam::Error);
  EXPECT_THROW(w.step({}, nan), roam::Error);
  EXPECT_THROW(w.place({0.0, nan, 0.0}), roam::Error);
}

TEST(Walker, WishesAreAtMostOneAndFiveTimesAsFastInAHurry) {
  const WalkerSettings s;
  EXPECT_EQ(roam::wish_velocity(s, {0.5, 0.0, 0.0}, false).x, 0.7);
  EXPECT_EQ(roam::wish_velocity(s, {3.0, 0.0, 0.0}, false).x, 1.4);
  EXPECT_EQ(roam::wish_velocity(s, {1.0, 0.0, 0.0}, true).x, 7.0);
}

}  // namespace
