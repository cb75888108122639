/// \file
/// Wishes with limits of acceleration: how fast the speed changes, and how far it takes to stop.

#include "motion/pace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "roam/error.h"
#include "roam/route.h"
#include "walker_judged.h"

namespace {

using namespace scenes;
using roam::Outcome;
using roam::Route;
using roam::RouteOptions;
using roam::WalkerInput;

double length(const Vec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

Vec3 level(const Vec3& v) { return {v.x, v.y, 0.0}; }

Vec3 start_of(Mode mode) { return {-15.0, 0.0, mode == Mode::walk ? 0.91 : 2.0}; }

constexpr Mode moving[] = {Mode::walk, Mode::fly, Mode::ghost};

/// A world with a limit of speed, as a store has while it loads.
class Limited final : public roam::Space {
 public:
  explicit Limited(const World& world) : world_(world) {}
  [[nodiscard]] roam::SpaceFacts facts() const override {
    roam::SpaceFacts facts = world_.facts();
    facts.speed_limit = 0.5;
    return facts;
  }
  [[nodiscard]] roam::Object object(roam::TriangleId triangle) const override { return world_.object(triangle); }

 protected:
  [[nodiscard]] roam::FirstImpact find_first(const roam::Query& query, roam::Vicinity* vicinity) const override {
    return find_first_of(world_, query, vicinity);
  }
  void find_near(const roam::Query& query, roam::Collector& collector, roam::Vicinity* vicinity) const override {
    find_near_of(world_, query, collector, vicinity);
  }

 private:
  const World& world_;
};

TEST(Pace, ALimitOfSpeedDoesNotCountTheVerticalPartOfAWalkersWish) {
  const World world = build(floor_mesh());
  const Limited space(world);
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    Walker w(space, {}, mode, start_of(mode));
    for (int i = 0; i < 60; ++i) w.step({{0.4, 0.0, 4.0}}, frame);
    EXPECT_EQ(w.report().has(EventKind::slowed), mode == Mode::fly);
    EXPECT_NEAR(w.position().x - start_of(mode).x, mode == Mode::walk ? 0.4 : 0.5 * 0.4 / std::hypot(0.4, 4.0), 1e-6);
  }
}

TEST(Pace, ABodyStopsInTheDistanceThatPhysicsSays) {
  const Mesh m = floor_mesh();
  const World world = build(m);
  for (const Mode mode : moving) {
    for (const double speed : {1.4, 7.0}) {
      for (const double braking : {0.9, 3.0, 500.0}) {
        for (const double dt : {1.0 / 240.0, frame, 0.037, 0.5}) {
          SCOPED_TRACE(testing::Message() << to_string(mode) << ' ' << speed << " m/s, " << braking << " m/s2, " << dt);
          Walker w(world, {}, mode, start_of(mode));
          w.step({.velocity = {speed, 0.0, 0.0}}, frame);
          const double from = w.position().x;
          double seconds = 0.0;
          do {
            w.step({.velocity = Vec3(0.0), .braking = braking}, dt);
            seconds += dt;
          } while (length(w.velocity()) > 0.0 && seconds < 100.0);
          EXPECT_NEAR(w.position().x - from, speed * speed / (2.0 * braking), 1e-9);
          EXPECT_NEAR(seconds, speed / braking, 2.0 * dt);
          EXPECT_EQ(w.pace(), Vec3(0.0));
        }
      }
    }
  }
}

TEST(Pace, ABodyGetsGoingInTheDistanceThatPhysicsSays) {
  const Mesh m = floor_mesh();
  const World world = build(m);
  for (const Mode mode : moving) {
    for (const double dt : {frame, 0.037, 0.25}) {
      SCOPED_TRACE(testing::Message() << to_string(mode) << ' ' << dt);
      Walker w(world, {}, mode, start_of(mode));
      const double from = w.position().x;
      double seconds = 0.0;
      while (w.pace().x < 3.0 && seconds < 100.0) {
        w.step({.velocity = {3.0, 0.0, 0.0}, .acceleration = 2.0}, dt);
        seconds += dt;
        EXPECT_NEAR(w.pace().x, std::min(3.0, 2.0 * seconds), 1e-12);
      }
      EXPECT_NEAR(w.position().x - from, 3.0 * 3.0 / 4.0 + 3.0 * (seconds - 1.5), 1e-9);
    }
  }
}

TEST(Pace, HowFarABodyGoesDoesNotDependOnTheTimeStep) {
  const Mesh m = floor_mesh();
  const World world = build(m);
  for (const Mode mode : moving) {
    Walker fine(world, {}, mode, start_of(mode)), coarse = fine;
    for (int i = 0; i < 10; ++i) {
      const Vec3 wish = i % 3 == 0 ? Vec3(2.0, 0.0, 0.0) : i % 3 == 1 ? Vec3(0.5, 1.0, 0.0) : Vec3(-1.0, -0.5, 0.0);
      const WalkerInput input{.velocity = wish, .acceleration = 4.0, .braking = 6.0};
      for (int k = 0; k < 50; ++k) fine.step(input, 0.01);
      coarse.step(input, 0.5);
      EXPECT_NEAR(fine.position().x, coarse.position().x, 1e-9) << i;
      EXPECT_NEAR(fine.position().y, coarse.position().y, 1e-9) << i;
    }
  }
}

TEST(Pace, WithoutLimitsTheWishIsHadAtOnce) {
  const Mesh m = floor_mesh();
  const World world = build(m);
  for (const Mode mode : moving) {
    Walker w(world, {}, mode, start_of(mode));
    for (const double speed : {2.0, -1.0, 5.0, 0.0}) {
      const double before = w.position().x;
      w.step({.velocity = {speed, 0.0, 0.0}}, 0.25);
      EXPECT_NEAR(w.position().x, before + speed * 0.25, 1e-12);
      EXPECT_EQ(w.pace().x, speed);
    }
  }
}

/// Boxes and steps in a closed hall.
Mesh cluttered_hall(Random& random) {
  Mesh m;
  add_box(m, {-6.0, -6.0, 0.0}, {6.0, 6.0, 4.0});
  for (int i = 0; i < 16; ++i) {
    const Vec3 at(random.between(-5.0, 5.0), random.between(-5.0, 5.0), 0.0);
    add_box(m, at, at + Vec3(random.between(0.1, 1.5), random.between(0.1, 1.5), random.between(0.05, 2.5)));
  }
  return m;
}

/// In random walks, every step of which is judged by brute force, no step is faster than the one before by more than
/// the limit allows; and slower only where something is touched.
TEST(Pace, NoSpeedChangesFasterThanTheLimit) {
  int free_steps = 0, touching = 0;
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      Random random(seed);
      const Mesh m = cluttered_hall(random);
      Walk w(m, {}, mode, {0.0, 0.0, 3.0});
      if (w.walker.held()) continue;
      Vec3 wish(0.0);
      Vec3 before(0.0);
      double dt_before = frame;
      bool was_free = false;
      for (int i = 0; i < 1500; ++i) {
        if (random.chance(0.03)) {
          const double a = random.between(0.0, 2.0 * std::numbers::pi), speed = random.between(0.0, 4.0);
          wish = Vec3(speed * std::cos(a), speed * std::sin(a), mode == Mode::fly ? random.between(-1.0, 1.0) : 0.0);
        }
        const double acceleration = 3.0, braking = 5.0, dt = random.between(0.004, 0.03);
        const StepReport& r = w.walker.step({.velocity = wish, .acceleration = acceleration, .braking = braking}, dt);
        ASSERT_GE(margin(w.judge, r, w.walker.settings().radius), 0.0) << i;
        const Vec3 now = mode == Mode::walk ? level(w.walker.velocity()) : w.walker.velocity();
        const double most = braking * 0.5 * (dt + dt_before) + 1e-9;
        // A rim is got onto, and off, at once.
        const bool steps = r.has(EventKind::stepped_up) || r.has(EventKind::stepped_down);
        if (!steps && !r.put_back) {
          ASSERT_LE(length(now), length(before) + most) << to_string(mode) << ' ' << seed << " step " << i;
        }
        const bool free = r.contacts.empty() && !steps;
        if (free && was_free) {
          ASSERT_LE(length(now - before), most) << to_string(mode) << ' ' << seed << " step " << i;
          ++free_steps;
        }
        touching += free ? 0 : 1;
        was_free = free;
        before = now;
        dt_before = dt;
      }
    }
  }
  EXPECT_GT(free_steps, 3000);
  EXPECT_GT(touching, 1000);
}

TEST(Pace, WhatStopsABodyTakesItsSpeed) {
  Mesh m = floor_mesh();
  add_wall(m, 2.0, -10.0, 2.0, 10.0, 0.0, 3.0);
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    Walk w(m, {}, mode, {0.0, 0.0, 0.91});
    const auto push = [&](const Vec3& wish) {
      return w.walker.step({.velocity = wish, .acceleration = 2.0, .braking = 2.0}, frame);
    };
    for (int i = 0; i < 240; ++i) push({3.0, 0.0, 0.0});
    ASSERT_TRUE(w.walker.report().blocked);
    EXPECT_EQ(w.walker.pace(), Vec3(0.0));
    push({-3.0, 0.0, 0.0});
    EXPECT_NEAR(w.walker.pace().x, -2.0 * frame, 1e-12);
    // Along the wall it goes on gaining speed.
    w.walker.place({1.0, -8.0, 0.91});
    for (int i = 0; i < 240; ++i) push({1.0, 2.0, 0.0});
    EXPECT_NEAR(w.walker.pace().y, 2.0, 0.01);
    EXPECT_NEAR(w.walker.pace().x, 0.0, 0.01);
    const Vec3 before = w.walker.pace();
    w.walker.step({.velocity = {9.0, 0.0, 0.0}, .acceleration = 1.0, .braking = 1.0}, 0.0);
    EXPECT_NEAR(length(w.walker.pace() - before), 0.0, 1e-12) << "no time, no change";
    w.walker.place({0.0, 0.0, 0.91});
    EXPECT_EQ(w.walker.pace(), Vec3(0.0));
  }
}

double route_seconds(double leg, double speed, double acceleration, double braking) {
  return leg / speed + 0.5 * speed / acceleration + 0.5 * speed / braking;
}

TEST(Pace, ARouteRestsWhereItTurnsAndAtItsEnd) {
  const Mesh m = floor_mesh();
  const World world = build(m);
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    for (const double dt : {frame, 0.1}) {
      SCOPED_TRACE(testing::Message() << to_string(mode) << ' ' << dt);
      const double z = 0.91;
      const std::vector<Vec3> path{{-15.0, -5.0, z}, {-9.0, -5.0, z}, {-3.5, -5.0, z}, {-3.0, -5.0, z}, {-3.0, 4.0, z}};
      Walker w(world, {}, mode, path[0]);
      Route route(w, path, {.speed = 2.0, .dt = dt, .acceleration = 1.5, .braking = 2.5});
      double most = 0.0, before = 0.0, dt_before = dt;
      while (!route.done()) {
        const StepReport& r = route.advance();
        const double now = length(level(w.velocity()));
        most = std::max(most, now);
        ASSERT_LE(now - before, 1.5 * 0.5 * (r.elapsed + dt_before) + 1e-6) << w.position().x;
        ASSERT_GE(now - before, -2.5 * 0.5 * (r.elapsed + dt_before) - 1e-6) << w.position().x;
        before = now;
        dt_before = r.elapsed;
      }
      const roam::RouteResult& result = route.result();
      EXPECT_EQ(result.outcome, Outcome::reached);
      EXPECT_EQ(result.waypoints, 5u);
      EXPECT_NEAR(result.length, 21.0, 1e-3) << "no corner is cut";
      EXPECT_NEAR(most, 2.0, 1e-6);
      EXPECT_NEAR(result.simulated, route_seconds(12.0, 2.0, 1.5, 2.5) + route_seconds(9.0, 2.0, 1.5, 2.5), 4.0 * dt);
      EXPECT_NEAR(result.end.y, 4.0, 1e-6);
      EXPECT_LT(length(w.pace()), 1e-3);
    }
  }
}

TEST(Pace, ARouteThatHardlyAcceleratesIsNotBlocked) {
  const Mesh m = floor_mesh();
  const World world = build(m);
  for (const double limit : {0.01, 0.2}) {
    Walker w(world, {}, Mode::walk, {0.0, 0.0, 0.91});
    const RouteOptions options{.acceleration = limit, .braking = limit};
    EXPECT_EQ(roam::follow(w, std::vector<Vec3>{{0.0, 0.0, 0.91}, {3.0, 0.0, 0.91}}, options).outcome,
              Outcome::reached);
  }
}

TEST(Pace, ALimitedRouteIsBlockedByAWall) {
  Mesh m = floor_mesh();
  add_wall(m, 2.0, -10.0, 2.0, 10.0, 0.0, 3.0);
  const World world = build(m);
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    Walker w(world, {}, mode, {0.0, 0.0, 0.91});
    const RouteOptions options{.acceleration = 1.0, .braking = 1.0};
    const auto result = roam::follow(w, std::vector<Vec3>{{0.0, 0.0, 0.91}, {5.0, 0.0, 0.91}}, options);
    EXPECT_EQ(result.outcome, Outcome::blocked);
    EXPECT_LT(result.simulated, 10.0);
  }
}

TEST(Pace, ALimitedRouteEndsBelowOrAboveAWaypointOutOfReach) {
  const World world = build(floor_mesh());
  for (const Vec3& goal : {Vec3(3.0, 0.0, 4.0), Vec3(3.0, 0.0, -4.0), Vec3(0.0, 0.0, 5.0)}) {
    for (const RouteOptions& options : {RouteOptions{.acceleration = 4.0}, RouteOptions{.braking = 4.0}}) {
      SCOPED_TRACE(testing::Message() << goal.x << ' ' << goal.z << ' ' << options.braking);
      const std::vector<Vec3> path{{0.0, 0.0, 0.91}, goal};
      Walker w(world, {}, Mode::walk, path[0]);
      Route route(w, path, options);
      for (int i = 0; i < 1000 && !route.done(); ++i) route.advance();
      ASSERT_TRUE(route.done());
      EXPECT_EQ(route.result().outcome, Outcome::blocked);
      EXPECT_NEAR(route.result().end.x, goal.x, 1e-6);
    }
  }
}

TEST(Pace, ALimitedRouteIsReachedInStepsOfAnyLength) {
  const World world = build(floor_mesh());
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    for (const double dt : {1e6, 1e20, 1e150}) {
      SCOPED_TRACE(testing::Message() << to_string(mode) << ' ' << dt);
      const std::vector<Vec3> path{{0.0, 0.0, 0.91}, {3.0, 0.0, 0.91}, {-3.0, 2.0, 0.91}};
      Walker w(world, {}, mode, path[0]);
      Route route(w, path, {.dt = dt, .acceleration = 2.0, .braking = 3.0});
      for (int i = 0; i < 100 && !route.done(); ++i) route.advance();
      ASSERT_TRUE(route.done());
      EXPECT_EQ(route.result().outcome, Outcome::reached);
    }
  }
}

TEST(Pace, LimitsThatAreNoneAreRefused) {
  const Mesh m = floor_mesh();
  const World world = build(m);
  Walker w(world, {}, Mode::walk, {0.0, 0.0, 0.91});
  const std::vector<Vec3> path{{0.0, 0.0, 0.91}, {3.0, 0.0, 0.91}};
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(w.step({.acceleration = bad}, frame), roam::Error);
    EXPECT_THROW(w.step({.braking = bad}, frame), roam::Error);
    EXPECT_THROW(Route(w, path, {.acceleration = bad}), roam::Error);
    EXPECT_THROW(Route(w, path, {.braking = bad}), roam::Error);
  }
}

TEST(Pace, AnApproachComesAsFarAsItSays) {
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    const double speed = random.between(0.0, 6.0), until_rest = random.between(0.01, 5.0);
    const double goal = until_rest * random.between(0.1, 1.0), seconds = random.between(1e-3, 0.5);
    WalkerInput limits;
    limits.acceleration = random.between(0.2, 9.0);
    limits.braking = random.between(0.2, 9.0);
    const auto step = roam::walking::approach(speed, random.between(0.1, 6.0), goal, until_rest, seconds, limits);
    ASSERT_LE(step.seconds, seconds);
    const double rate = step.speed < speed ? -limits.braking : limits.acceleration;
    const double changing = std::min(std::abs((step.speed - speed) / rate), step.seconds);
    const double way = (speed + 0.5 * rate * changing) * changing + step.speed * (step.seconds - changing);
    ASSERT_NEAR(step.way, way, 1e-9) << i;
    ASSERT_LE(step.way, goal);
  }
}

}  // namespace
