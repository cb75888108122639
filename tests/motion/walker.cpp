#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "roam/error.h"
#include "walker_judged.h"

namespace {

using namespace scenes;

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
  add_wall(m, 2.0, -10.0, 2.0, 10.0, 0.0, 3.0);
  Walk w(m, {}, Mode::walk, {0.0, 0.0, 0.95});
  w.go({1.0, 1.0, 0.0}, 5.0);
  EXPECT_NEAR(w.walker.position().x, 1.7, near_ground);
  EXPECT_NEAR(w.walker.position().y, 5.0, 0.02);
  EXPECT_GT(w.count(EventKind::slid), 0);
}

Mesh corner(double degrees) {
  Mesh m = floor_mesh();
  const double a = 0.5 * degrees * std::numbers::pi / 180.0, c = 4.0 * std::cos(a), s = 4.0 * std::sin(a);
  add_wall(m, 2.0, 0.0, 2.0 - c, s, 0.0, 3.0);
  add_wall(m, 2.0, 0.0, 2.0 - c, -s, 0.0, 3.0);
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
  add_quad(m, {2.0, -10.0, -10.0}, {2.0, 10.0, -10.0}, {2.0, 10.0, 10.0}, {2.0, -10.0, 10.0});
  add_quad(m, {-10.0, 2.0, -10.0}, {10.0, 2.0, -10.0}, {10.0, 2.0, 10.0}, {-10.0, 2.0, 10.0});
  Walk w(m, {}, Mode::fly, {0.0, 0.0, -5.0});
  w.go({1.0, 1.0, 1.0}, 6.0);
  EXPECT_NEAR(w.walker.position().x, 1.7, near_ground);
  EXPECT_NEAR(w.walker.position().y, 1.7, near_ground);
  EXPECT_NEAR(w.walker.position().z, 1.0, 0.05);
}

TEST(Walker, StopsWhereThreeWallsMeet) {
  Mesh m;
  add_box(m, {-3.0, -3.0, -3.0}, {3.0, 3.0, 3.0});
  Walk w(m, {}, Mode::fly, {0.0, 0.0, 0.0});
  w.go({5.0, 4.0, 3.0}, 3.0);
  const Vec3 rest = w.walker.position();
  EXPECT_NEAR(rest.x, 2.7, near_ground);
  EXPECT_NEAR(rest.y, 2.7, near_ground);
  EXPECT_NEAR(rest.z, 2.1, near_ground);
  w.go({5.0, 4.0, 3.0}, 1.0);
  EXPECT_EQ(w.walker.position(), rest);
}

TEST(Walker, NeverPassesAThinWallAtAnySpeedAndTimeStep) {
  Mesh m = floor_mesh();
  add_box(m, {-6.0, -6.0, -0.5}, {6.0, 6.0, 4.0});
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    for (const double speed : {0.1, 1.4, 50.0, 3000.0, 1e7}) {
      for (const double dt : {1e-6, 1e-3, frame, 0.5, 10.0, 1e4}) {
        Walk w(m, {}, mode, {0.0, 0.0, 0.95});
        Random random(11);
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
  EXPECT_LE(r.segments.size(), 3u);
  EXPECT_EQ(r.elapsed, 10.0);
}

TEST(Walker, AStepOfNoTimeDoesNothing) {
  const Mesh m = floor_mesh();
  Walk w(m, {}, Mode::walk, {0.0, 0.0, 0.95});
  const Vec3 before = w.walker.position();
  EXPECT_EQ(w.step({1.4, 0.0, 0.0}, 0.0).segments.size(), 0u);
  EXPECT_EQ(w.walker.position(), before);
}

TEST(Walker, AStepOfTheShortestTimeIsNotBlocked) {
  const Mesh m = floor_mesh();
  Walk w(m, {}, Mode::walk, {0.0, 0.0, 0.95});
  EXPECT_FALSE(w.step({0.3, 0.0, 0.0}, std::numeric_limits<double>::denorm_min()).blocked);
}

TEST(Walker, WithoutGravityFloatsOnFromAnEdgeAndBelowTheScene) {
  Mesh m;
  add_floor(m, -10.0, -10.0, 10.0, 10.0, 10.0);
  const WalkerSettings floating{.gravity = 0.0};
  for (const Vec3& start : {Vec3(8.0, 0.0, 10.91), Vec3(8.0, 0.0, 1.0)}) {
    Walk w(m, floating, Mode::walk, start);
    w.go({1.4, 0.0, 0.0}, 2.0);
    const Vec3 off = w.walker.position();  // it has rolled off the rim
    EXPECT_NEAR(off.z, start.z, 0.25);
    w.go({1.4, 0.0, 0.0}, 4.0);
    EXPECT_NEAR(w.walker.position().x, off.x + 5.6, 1e-6);
    EXPECT_NEAR(w.walker.position().z, off.z, 1e-6);
    EXPECT_EQ(w.count(EventKind::put_back) + w.count(EventKind::held), 0);
  }
}

/// The first fall is lost in the rounding of z.
TEST(Walker, FallsByTheShortestStepsFarAboveTheOrigin) {
  for (const double height : {1e5, 6.4e6}) {
    Mesh m;
    add_floor(m, -10.0, -10.0, 10.0, 10.0, height);
    const World world = build(m);
    Walker walker(world, {}, Mode::walk, {0.0, 0.0, height + 3.0});
    const double dt = height < 1e6 ? 1e-6 : 9e-6;
    constexpr int steps = 50'000;
    for (int i = 0; i < steps; ++i) walker.step({}, dt);
    const double fallen = 0.5 * 9.81 * (steps * dt) * (steps * dt);
    EXPECT_NEAR(height + 3.0 - walker.position().z, fallen, 0.02 * fallen);
  }
}

TEST(Walker, AnyFiniteWishLeavesItWell) {
  const Mesh m = floor_mesh();
  for (const double speed : {1e155, 1e300, -1e308}) {
    Walk w(m, {}, Mode::walk, {0.0, 0.0, 9.0});
    w.walker.step({.velocity = {speed, speed, 0.0}, .acceleration = 10.0, .braking = 10.0}, 0.1);
    EXPECT_LT(w.walker.position().z, 8.99);
    w.step({speed, 0.0, 0.0});
    w.step({0.0, 0.0, 0.0}, 0.5);
    EXPECT_LT(w.walker.position().z, 8.5);
    w.go({0.0, 0.0, 0.0}, 3.0);
    const double x = w.walker.position().x;
    EXPECT_GT(w.step({1.4, 0.0, 0.0}).elapsed, 0.0);
    EXPECT_TRUE(std::isfinite(x));
  }
}

TEST(Walker, AGhostThatWouldLeaveAllSpaceStaysWhereItIs) {
  const Mesh m = floor_mesh();
  Walk w(m, {}, Mode::ghost, {0.0, 0.0, 0.95});
  EXPECT_THROW(w.walker.step({.velocity = {1e308, 0.0, 0.0}}, 100.0), roam::Error);
  EXPECT_THROW(w.walker.step({.velocity = {1e300, 0.0, 0.0}}, 1.0), roam::Error);
  EXPECT_EQ(w.walker.position(), Vec3(0.0, 0.0, 0.95));
  EXPECT_EQ(w.walker.step({.velocity = {1.0, 0.0, 0.0}}, 1.0).to, Vec3(1.0, 0.0, 0.95));
}

TEST(Walker, IsPutNowhereOutsideAllSpace) {
  const World world = build(floor_mesh());
  for (const Mode mode : {Mode::walk, Mode::fly, Mode::ghost}) {
    Walker w(world, {}, mode, {0.0, 0.0, 0.95});
    const Vec3 before = w.position();
    for (const double far : {1.7e308, 1e200, 2e9, -2e9}) {
      for (int k = 0; k < 3; ++k) {
        Vec3 at(0.0, 0.0, 1.0);
        at[k] = far;
        EXPECT_THROW(w.place(at), roam::Error) << far;
        EXPECT_THROW(w.place_feet(at), roam::Error) << far;
        EXPECT_EQ(w.position(), before) << far;
      }
    }
    EXPECT_THROW(w.place_feet({0.0, 0.0, 1e9}), roam::Error) << "its centre is farther";
    w.step({.velocity = {1.0, 0.0, 0.0}}, 1.0);
    EXPECT_NEAR(w.position().x, 1.0, 1e-9) << to_string(mode);
    w.place({1e9, 0.0, 0.0});
    if (mode == Mode::walk) continue;  // nothing is below
    w.step({.velocity = {-1.0, 0.0, 0.0}}, 1.0);
    EXPECT_EQ(w.position().x, 1e9 - 1.0) << to_string(mode);
  }
}

/// A narrower body over 0.3 m of each metre along +x, from x = -19: two events each.
std::vector<roam::SizeRegion> many_regions(int count) {
  std::vector<roam::SizeRegion> regions;
  for (int i = 0; i < count; ++i) {
    const double x = -19.0 + i;
    regions.push_back({{Vec3(x, -1.0, -1.0), Vec3(x + 0.3, 1.0, 3.0)}, 0.2, 0.0, ""});
  }
  return regions;
}

TEST(Walker, AStepOfManyEventsKeepsWhatEndsIt) {
  const Mesh m = floor_mesh();
  const World world = build(m);
  Walker w(world, {}, Mode::walk, {-20.0, 0.0, 0.95});
  w.set_regions(many_regions(30));
  const StepReport& r = w.step({.velocity = {1.4, 0.0, 0.0}}, 1e6);
  EXPECT_EQ(r.events.total(), r.events.size()) << "nothing is lost beyond what motion may note";
  EXPECT_EQ(r.has(EventKind::throttled), r.elapsed < 1e6);
}

TEST(Walker, AStepOfManyEventsReportsTheFallAfterThem) {
  Mesh m;
  add_floor(m, -20.0, -10.0, -10.0, 10.0, 0.0);
  add_floor(m, -10.0, -10.0, 20.0, 10.0, -3.0);
  const World world = build(m);
  Walker w(world, {.step = 0.05}, Mode::walk, {-20.0, 0.0, 0.95});
  w.set_regions(many_regions(8));
  const StepReport& r = w.step({.velocity = {1.4, 0.0, 0.0}}, 10.0);
  EXPECT_DOUBLE_EQ(w.fall_limit(), 0.3 + 0.05);
  ASSERT_LT(w.feet().z, -w.fall_limit());
  const auto fall =
      std::find_if(r.events.begin(), r.events.end(), [](const roam::Event& e) { return e.kind == EventKind::fell; });
  EXPECT_EQ(fall - r.events.begin(), 16) << "the others fill their share of the list";
}

TEST(Walker, GivesTheSameBitsOnEveryRunAndWithAnyNumberOfThreads) {
  Mesh m = rough_tiling(90, 5);
  Random clutter(9);
  for (int i = 0; i < 30; ++i) {
    const Vec3 lo(clutter.between(-9.0, 9.0), clutter.between(-9.0, 9.0), 0.0);
    if (std::abs(lo.x) < 1.5 && std::abs(lo.y) < 1.5) continue;
    add_box(m, lo, lo + Vec3(clutter.between(0.1, 1.0), clutter.between(0.1, 1.0), clutter.between(0.1, 2.0)));
  }
  std::vector<Vec3> first;
  for (const int threads : {1, 1, 2, 5}) {
    roam::BuildOptions options;
    options.threads = threads;
    const World world = World::build({&m, 1}, options);
    Walker w(world, {}, Mode::walk, {0.0, 0.0, 0.95});
    Random random(21);
    std::vector<Vec3> trace;
    for (int i = 0; i < 2000; ++i) {
      const double a = random.between(0.0, 2.0 * std::numbers::pi);
      w.step({{2.0 * std::cos(a), 2.0 * std::sin(a), 0.0}, random.chance(0.02)}, random.between(0.0, 0.2));
      for (const roam::Segment& c : w.report().segments) trace.push_back(c.position);
    }
    if (first.empty()) first = trace;
    ASSERT_EQ(first.size(), trace.size());
    EXPECT_EQ(std::memcmp(first.data(), trace.data(), first.size() * sizeof(Vec3)), 0) << threads << " threads";
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
  EXPECT_TRUE(refused({.radius = 0.000999, .height = 0.01, .eye = 0.0, .step = 0.0}, "at least 0.001 and at most 125"));
  EXPECT_NO_THROW(roam::check(WalkerSettings::sphere(0.001)));
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
  const World world = build(m);
  EXPECT_THROW(Walker(world, {.radius = -1.0}, Mode::walk, Vec3(0.0)), roam::Error);
  EXPECT_THROW(Walker(world, {}, Mode::walk, Vec3(nan)), roam::Error);
  Walker w(world, {}, Mode::walk, {0.0, 0.0, 0.95});
  EXPECT_THROW(w.step({{nan, 0.0, 0.0}}, frame), roam::Error);
  EXPECT_THROW(w.step({}, -1.0), roam::Error);
  EXPECT_THROW(w.step({}, nan), roam::Error);
  EXPECT_THROW(w.place({0.0, nan, 0.0}), roam::Error);
}

TEST(WalkerSettings, OfAPersonAreTakenForEverySize) {
  for (const double height : {0.6, 0.61, 0.7, 1.0, 1.2, 1.8, 2.4}) {
    const WalkerSettings s = WalkerSettings::person(0.3, height);
    EXPECT_NO_THROW(roam::check(s)) << height;
    EXPECT_EQ(s.body().radius, 0.3);
    EXPECT_NEAR(s.body().height(), height, 1e-12);
    EXPECT_NEAR(s.eye, height == 0.6 ? 0.3 : height * 16.0 / 18.0, 1e-12);
  }
  const WalkerSettings grown, person = WalkerSettings::person(0.3, 1.8);
  EXPECT_EQ(person.eye, grown.eye);
  EXPECT_EQ(person.step, grown.step);
  EXPECT_EQ(person.crouch_height, grown.crouch_height);
  EXPECT_NO_THROW(roam::check(WalkerSettings::person(0.2, 0.4)));
}

TEST(WalkerSettings, WithABodyTooLowForTheEyeSayWhatToDo) {
  try {
    roam::check({.height = 1.2});
    FAIL() << "the eye is above the body";
  } catch (const roam::Error& error) {
    EXPECT_NE(std::string(error.what()).find("WalkerSettings::person"), std::string::npos) << error.what();
  }
}

TEST(Walker, WishesAreAtMostOneAndFiveTimesAsFastInAHurry) {
  const WalkerSettings s;
  EXPECT_EQ(roam::wish_velocity(s, {0.5, 0.0, 0.0}, false).x, 0.7);
  EXPECT_EQ(roam::wish_velocity(s, {3.0, 0.0, 0.0}, false).x, 1.4);
  EXPECT_EQ(roam::wish_velocity(s, {1.0, 0.0, 0.0}, true).x, 7.0);
  EXPECT_EQ(roam::wish_velocity(s, {0.0, -1e200, 0.0}, false), roam::Vec3(0.0, -1.4, 0.0));
  constexpr double largest = std::numeric_limits<double>::max();
  const roam::Vec3 wish = roam::wish_velocity(s, {largest, largest, 0.0}, false);
  EXPECT_NEAR(wish.x, 1.4 * std::sqrt(0.5), 1e-15);
  EXPECT_EQ(wish.y, wish.x);
  EXPECT_THROW((void)roam::wish_velocity(s, {0.0, std::numeric_limits<double>::infinity(), 0.0}, false), roam::Error);
}

}  // namespace
