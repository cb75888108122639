#include "roam/route.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "changing_room.h"
#include "motion/vain_steps.h"
#include "roam/error.h"
#include "roam/standing.h"
#include "walker_scenes.h"

namespace {

using roam::EventKind;
using roam::Mesh;
using roam::Mode;
using roam::Outcome;
using roam::RouteOptions;
using roam::RouteResult;
using roam::Vec3;
using roam::Walker;
using roam::WalkerSettings;
using roam::World;

RouteResult follow(const Mesh& mesh, const WalkerSettings& settings, Mode mode, const std::vector<Vec3>& waypoints,
                   const RouteOptions& options = {}) {
  const World world = scenes::build(mesh);
  Walker walker(world, settings, mode, waypoints.empty() ? Vec3(0.0) : waypoints[0]);
  return roam::follow(walker, waypoints, options);
}

Mesh floor_mesh() {
  Mesh m;
  scenes::add_floor(m, -20.0, -10.0, 20.0, 10.0, 0.0);
  return m;
}

bool has(const RouteResult& r, EventKind kind) {
  for (const roam::RouteEvent& e : r.events) {
    if (e.event.kind == kind) return true;
  }
  return false;
}

TEST(Route, IsReachedExactlyAndTakesLengthBySpeedWhenNothingIsInTheWay) {
  const RouteResult r = follow(floor_mesh(), {}, Mode::fly, {{-10.0, 0.0, 5.0}, {0.0, 0.0, 5.0}, {0.0, 7.0, 6.0}},
                               {.speed = 50.0, .dt = 1.0 / 60.0});
  EXPECT_EQ(r.outcome, Outcome::reached);
  EXPECT_EQ(r.waypoints, 3u);
  EXPECT_NEAR(r.length, 10.0 + std::sqrt(50.0), 1e-6);
  EXPECT_NEAR(r.simulated, r.length / 50.0, 1e-6);
  EXPECT_NEAR(r.end.y, 7.0, 1e-6);
  EXPECT_NEAR(r.least_axis_clearance, 1.3, 1e-9);  // capped at radius and reach
}

TEST(Route, DoesNotCutCorners) {
  const RouteResult r = follow(floor_mesh(), {}, Mode::walk, {{-5.0, 0.0, 0.91}, {0.0, 0.0, 0.9}, {0.0, 5.0, 0.9}});
  EXPECT_EQ(r.outcome, Outcome::reached);
  EXPECT_NEAR(r.length, 10.0, 1e-3);
}

TEST(Route, OfManyCloseWaypointsIsAsFastAsOfFew) {
  std::vector<Vec3> path;
  for (int i = 0; i <= 2000; ++i) path.push_back({-5.0 + 0.005 * i, 0.0, 0.91});
  const RouteResult r = follow(floor_mesh(), {}, Mode::walk, path);
  EXPECT_EQ(r.outcome, Outcome::reached);
  EXPECT_NEAR(r.simulated, 10.0 / 1.4, 0.01);
}

TEST(Route, AWaypointBehindAWallIsBlockedByThatWall) {
  Mesh m = floor_mesh();
  scenes::add_wall(m, 2.0, -10.0, 2.0, 10.0, 0.0, 3.0);
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    const RouteResult r = follow(m, {}, mode, {{-2.0, 0.0, 0.95}, {5.0, 0.0, 0.95}});
    EXPECT_EQ(r.outcome, Outcome::blocked);
    ASSERT_TRUE(r.blocked_at);
    EXPECT_NEAR(r.blocked_at->point.x, 2.0, 1e-3);
    EXPECT_NEAR(r.blocked_at->normal.x, -1.0, 1e-3);
    EXPECT_GE(r.blocked_at->triangle, 2u);
    EXPECT_EQ(r.blocked_at->object, 0u);
    EXPECT_FALSE(r.blocked_at->opening);
    EXPECT_EQ(r.waypoints, 1u);
    EXPECT_GE(r.least_axis_clearance, 0.3 - 1e-6);
    EXPECT_LT(r.simulated, 10.0);
  }
}

TEST(Route, SlidesAlongAWallToAWaypointThatIsNotHeadOn) {
  Mesh m = floor_mesh();
  scenes::add_wall(m, -10.0, 1.0, 5.0, 1.0, 0.0, 3.0);
  const RouteResult r = follow(m, {}, Mode::walk, {{-6.0, 0.0, 0.95}, {7.0, 3.0, 0.95}});
  EXPECT_EQ(r.outcome, Outcome::reached);
  EXPECT_TRUE(has(r, EventKind::slid));
}

TEST(Route, FollowsAWallToTheCornerWhereItEnds) {
  Mesh m;
  scenes::add_floor(m, -40.0, -40.0, 40.0, 40.0, 0.0);
  scenes::add_wall(m, -30.0, 0.0, 0.0, 0.0, 0.0, 3.0);
  scenes::add_wall(m, 0.0, 0.0, 0.0, 0.4, 0.0, 3.0);
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    for (const double beyond : {1.0, 4.0, 8.0}) {
      for (const double aside : {0.5, 1.0, 3.0, 8.0}) {
        const RouteResult r = follow(m, {}, mode, {{-aside, -1.0, 0.95}, {0.6, beyond, 0.95}});
        EXPECT_EQ(r.outcome, Outcome::reached) << beyond << " m beyond the wall, from " << aside << " m aside";
      }
    }
  }
}

TEST(Route, EndsWhereAWallLeadsNoNearer) {
  Mesh m = floor_mesh();
  scenes::add_wall(m, -20.0, 0.0, 20.0, 0.0, 0.0, 3.0);
  for (const double aside : {0.0, 1.0, 15.0}) {
    const RouteResult r = follow(m, {}, Mode::walk, {{-aside, -1.0, 0.95}, {0.0, 8.0, 0.95}});
    EXPECT_EQ(r.outcome, Outcome::blocked);
    ASSERT_TRUE(r.blocked_at);
    EXPECT_NEAR(r.end.x, 0.0, 0.8);  // a twentieth of free motion, seen from 8.3 m
    EXPECT_LT(r.simulated, 60.0);
  }
}

Mesh low_doorway(double width, double lintel) {
  Mesh m = floor_mesh();
  const double half = 0.5 * width;
  scenes::add_wall(m, 1.0, -5.0, 1.0, -half, 0.0, 3.0);
  scenes::add_wall(m, 1.0, half, 1.0, 5.0, 0.0, 3.0);
  scenes::add_wall(m, 1.0, -half, 1.0, half, lintel, 3.0);
  return m;
}

TEST(Route, MeasuresTheOpeningThatIsTooNarrow) {
  for (const double width : {0.3, 0.45, 0.59}) {
    for (const double y : {0.0, 0.004}) {
      const RouteResult r = follow(low_doorway(width, 2.2), {}, Mode::walk, {{-2.0, y, 0.95}, {4.0, 0.0, 0.95}});
      EXPECT_EQ(r.outcome, Outcome::blocked);
      ASSERT_TRUE(r.blocked_at);
      ASSERT_TRUE(r.blocked_at->opening) << width;
      EXPECT_NEAR(*r.blocked_at->opening, width, 0.01);
    }
  }
}

TEST(Route, MeasuresADoorBetweenThickPostsAndNotOnePostAtTwoHeights) {
  for (const double width : {0.4, 0.5, 0.55}) {
    for (const double origin : {0.0, 1e5}) {
      const Vec3 at(origin, 0.0, 0.0);
      Mesh m;
      scenes::add_box(m, at + Vec3(0.0, 0.0, -0.1), at + Vec3(20.0, 4.0, 0.0));
      scenes::add_box(m, at + Vec3(10.0, 0.0, 0.0), at + Vec3(10.2, 2.0 - 0.5 * width, 3.0));
      scenes::add_box(m, at + Vec3(10.0, 2.0 + 0.5 * width, 0.0), at + Vec3(10.2, 4.0, 3.0));
      const roam::WalkerSettings person{.radius = 0.3, .height = 1.8};
      const RouteResult r = follow(m, person, Mode::walk, {at + Vec3(5.0, 2.0, 0.95), at + Vec3(15.0, 2.0, 0.95)});
      EXPECT_EQ(r.outcome, Outcome::blocked);
      ASSERT_TRUE(r.blocked_at && r.blocked_at->opening) << width << " m at " << origin;
      EXPECT_NEAR(*r.blocked_at->opening, width, 0.01) << "at " << origin;
    }
  }
}

TEST(Route, MeasuresTheOpeningThatIsTooLow) {
  const RouteResult r = follow(low_doorway(3.0, 0.9), {}, Mode::walk, {{-2.0, 0.0, 0.95}, {4.0, 0.0, 0.95}});
  EXPECT_EQ(r.outcome, Outcome::blocked);
  ASSERT_TRUE(r.blocked_at);
  ASSERT_TRUE(r.blocked_at->opening);
  EXPECT_NEAR(*r.blocked_at->opening, 0.9, 0.02);
}

Mesh split_street() {
  Mesh m;
  scenes::add_floor(m, -10.0, -5.0, -0.625, 5.0, 0.0);
  scenes::add_floor(m, 0.625, -5.0, 10.0, 5.0, 0.0);
  scenes::add_wall(m, -0.625, -5.0, -0.625, 5.0, -5.0, 0.0);
  scenes::add_wall(m, 0.625, -5.0, 0.625, 5.0, -5.0, 0.0);
  scenes::add_floor(m, -0.625, -5.0, 0.625, 5.0, -5.0);
  return m;
}

TEST(Route, OverASplitIsReachedByTheBallThatBridgesItAndFallsWithTheOther) {
  for (const double radius : {0.3, 0.6, 0.7}) {
    const WalkerSettings ball{.radius = radius, .height = 2.0 * radius, .eye = radius};
    const RouteResult r =
        follow(split_street(), ball, Mode::walk, {{-4.0, 1.0, radius}, {4.0, -1.0, radius}}, {.speed = 1.5});
    EXPECT_EQ(r.outcome, radius > 0.65 ? Outcome::reached : Outcome::fell) << radius;
    EXPECT_EQ(has(r, EventKind::fell), radius < 0.65);
  }
}

TEST(Route, ComesDownToTheGroundBeforeItGoes) {
  for (const double speed : {1.4, 50.0}) {
    const WalkerSettings ball{.radius = 0.6, .height = 1.2, .eye = 0.6};
    const RouteResult r =
        follow(split_street(), ball, Mode::walk, {{-4.0, 0.0, 2.5}, {4.0, 0.0, 2.5}}, {.speed = speed});
    EXPECT_EQ(r.outcome, Outcome::fell) << speed;
    EXPECT_TRUE(has(r, EventKind::landed));
  }
}

TEST(Route, OfOneWaypointIsReachedWhereItStarts) {
  const RouteResult r = follow(floor_mesh(), {}, Mode::walk, {{0.0, 0.0, 0.95}});
  EXPECT_EQ(r.outcome, Outcome::reached);
  EXPECT_EQ(r.steps, 0u);
}

TEST(Route, WithoutGravityDoesNotWaitForTheGround) {
  const WalkerSettings floating{.gravity = 0.0};
  const RouteResult r = follow(floor_mesh(), floating, Mode::walk, {{-2.0, 0.0, 3.0}, {2.0, 0.0, 3.0}});
  EXPECT_EQ(r.outcome, Outcome::reached);
}

TEST(Route, LeavesTheSceneOverTheSideOfTheFloor) {
  const RouteResult r = follow(floor_mesh(), {}, Mode::walk, {{18.0, 0.0, 0.95}, {30.0, 0.0, 0.95}});
  EXPECT_EQ(r.outcome, Outcome::left_scene);
  EXPECT_TRUE(has(r, EventKind::fell));
}

TEST(Route, LeavesTheSceneThroughAHoleWhenFlying) {
  Mesh m;
  scenes::add_box(m, {-5.0, -5.0, 0.0}, {5.0, 5.0, 4.0});
  m.triangles.erase(m.triangles.begin() + 6, m.triangles.begin() + 8);  // the wall at x = 5
  const RouteResult r = follow(m, {}, Mode::fly, {{0.0, 0.0, 2.0}, {50.0, 0.0, 2.0}}, {.speed = 5.0});
  EXPECT_EQ(r.outcome, Outcome::left_scene);
  EXPECT_NEAR(r.end.x, 5.6, 0.1);
  const RouteResult in = follow(m, {}, Mode::fly, {{50.0, 0.0, 2.0}, {0.0, 0.0, 2.0}}, {.speed = 5.0});
  EXPECT_EQ(in.outcome, Outcome::reached);
}

TEST(Route, IsHeldWhereItsStartDoesNotFit) {
  Mesh m = floor_mesh();
  scenes::add_wall(m, 0.0, -10.0, 0.0, 10.0, 0.0, 3.0);
  const RouteResult r = follow(m, {}, Mode::walk, {{0.0, 0.0, 0.95}, {5.0, 0.0, 0.95}});
  EXPECT_EQ(r.outcome, Outcome::held);
  EXPECT_EQ(r.steps, 0u);
  EXPECT_TRUE(has(r, EventKind::held));
}

TEST(Route, AWayOfTheFeetIsGoneBySomebodyWhoStandsOnIt) {
  const std::vector<Vec3> feet{{0.0, 0.0, 0.0}, {5.0, 0.0, 0.0}};
  EXPECT_EQ(follow(floor_mesh(), {}, Mode::walk, feet).outcome, Outcome::held) << "to the waist in the floor";
  for (const WalkerSettings& s : {WalkerSettings{}, WalkerSettings::sphere(0.3)}) {
    const RouteResult r = follow(floor_mesh(), s, Mode::walk, roam::standing(feet, s));
    EXPECT_EQ(r.outcome, Outcome::reached);
    EXPECT_NEAR(r.length, 5.0, 0.01);
  }
}

TEST(Route, IsHeldWhereTheSpaceLetsItCreepFarFromTheOrigin) {
  scenes::ChangingRoom room(scenes::hall(), true);
  Walker walker(room, {}, Mode::fly, {-8.0, -8.0, 0.0});
  room.limit = 0.02;  // of 1.4 m/s
  const RouteResult r = roam::follow(walker, std::vector<Vec3>{{-8.0, -8.0, 0.0}, {8.0, -8.0, 0.0}});
  EXPECT_EQ(r.outcome, Outcome::held);
  EXPECT_LT(r.end.x, -7.8);
}

TEST(Route, RefusesAStepAfterItsEnd) {
  const World world = scenes::build(floor_mesh());
  Walker walker(world, {}, Mode::walk, {0.0, 0.0, 0.95});
  const std::vector<Vec3> here{{0.0, 0.0, 0.95}};
  roam::Route route(walker, here);
  ASSERT_TRUE(route.done());
  EXPECT_THROW(route.advance(), roam::Error);
}

TEST(Route, IsHeldWhereItNeverFindsGround) {
  const RouteResult r = follow(floor_mesh(), {}, Mode::walk, {{25.0, 0.0, 0.95}, {30.0, 0.0, 0.95}});
  EXPECT_EQ(r.outcome, Outcome::held);
  EXPECT_GE(r.least_gap, 0.75);  // nothing came near: three quarters at least of how far clearances are told
  EXPECT_NEAR(r.least_axis_clearance, r.least_gap + 0.3, 1e-12);
}

TEST(Route, IsHeldWhereTheGroundIsTooFarBelowToComeDownTo) {
  const RouteResult r = follow(floor_mesh(), {}, Mode::walk, {{0.0, 0.0, 1e6}, {5.0, 0.0, 1e6}});
  EXPECT_EQ(r.outcome, Outcome::held);
  EXPECT_NEAR(r.simulated, roam::Route::longest_descent, 1.0);
}

TEST(Route, TellsTheClearanceOfItsMovesWhereSomethingComesUponTheBody) {
  Mesh m = floor_mesh();
  World world = scenes::build(m);
  Walker walker(world, {}, Mode::fly, {0.0, 0.0, 1.5});
  roam::Route route(walker, std::vector<Vec3>{{0.0, 0.0, 1.5}, {10.0, 0.0, 1.5}});
  for (int i = 0; i < 60; ++i) route.advance();
  const double least = route.result().least_axis_clearance;
  EXPECT_GT(least, 0.3);
  const double x = walker.position().x;
  scenes::add_wall(m, x, -10.0, x, 10.0, 0.0, 3.0);
  world = scenes::build(m);
  while (!route.done()) route.advance();
  EXPECT_EQ(route.result().outcome, Outcome::held);
  EXPECT_EQ(route.result().least_axis_clearance, least);
  EXPECT_NEAR(route.result().least_gap, least - 0.3, 1e-12);
}

TEST(Route, AWaypointOnTheGroundOrAtEyeHeightCountsAsReachedOnFoot) {
  for (const double z : {0.0, 0.3, 0.9, 1.6, 2.0}) {
    EXPECT_EQ(follow(floor_mesh(), {}, Mode::walk, {{-2.0, 0.0, 0.95}, {2.0, 0.0, z}}).outcome, Outcome::reached) << z;
  }
  for (const double z : {-0.4, 2.2}) {
    EXPECT_EQ(follow(floor_mesh(), {}, Mode::walk, {{-2.0, 0.0, 0.95}, {2.0, 0.0, z}}).outcome, Outcome::blocked) << z;
  }
}

TEST(Route, OfATallPersonIsReachedByALowBodyUnlessAFloorIsBetween) {
  const WalkerSettings ball{.radius = 0.3, .height = 0.6, .eye = 0.5};
  const auto outcome = [&](const Mesh& mesh, double height) {
    return follow(mesh, ball, Mode::walk, {{-5.0, 0.0, 0.31}, {0.0, 0.0, height}}).outcome;
  };
  EXPECT_EQ(outcome(floor_mesh(), 2.0), Outcome::reached);
  EXPECT_EQ(outcome(floor_mesh(), 2.02), Outcome::blocked);
  Mesh storeys = floor_mesh();
  scenes::add_floor(storeys, -2.0, -2.0, 2.0, 2.0, 1.5);
  EXPECT_EQ(outcome(storeys, 1.4), Outcome::reached);
  EXPECT_EQ(outcome(storeys, 1.6), Outcome::blocked);
}

TEST(Route, AWaypointTooNearAWallIsReachedAsNearAsTheBodyGets) {
  Mesh m = floor_mesh();
  scenes::add_wall(m, 2.0, -10.0, 2.0, 10.0, 0.0, 3.0);
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    const RouteResult r =
        follow(m, {}, mode, {{-2.0, 0.0, 0.95}, {1.9, 0.0, 0.95}, {1.9, 4.0, 0.95}, {0.0, 4.0, 0.95}});
    EXPECT_EQ(r.outcome, Outcome::reached);
  }
}

TEST(Route, EndsAfterARowOfStepsThatLeadNowhere) {
  roam::StepReport vain, short_on_purpose, far;
  vain.events.push({EventKind::throttled, Vec3(0.0)});
  far.events.push({EventKind::throttled, Vec3(0.0)});
  far.elapsed = 0.01;
  for (const roam::StepReport& other : {short_on_purpose, far}) {
    std::uint64_t row = 0;
    for (int i = 0; i < 63; ++i) EXPECT_FALSE(roam::is_vain_again(vain, row)) << i;
    EXPECT_FALSE(roam::is_vain_again(other, row));
    for (int i = 0; i < 63; ++i) EXPECT_FALSE(roam::is_vain_again(vain, row)) << i;
    EXPECT_TRUE(roam::is_vain_again(vain, row));
  }
}

TEST(Route, RefusesWhatCanNotBeFollowed) {
  const Mesh m = floor_mesh();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(follow(m, {}, Mode::walk, {}), roam::Error);
  EXPECT_THROW(follow(m, {}, Mode::walk, {Vec3(0.0), Vec3(nan)}), roam::Error);
  EXPECT_THROW(follow(m, {}, Mode::ghost, {Vec3(0.0)}), roam::Error);
  EXPECT_THROW(follow(m, {}, Mode::walk, {Vec3(0.0)}, {.speed = 0.0}), roam::Error);
  EXPECT_THROW(follow(m, {}, Mode::walk, {Vec3(0.0)}, {.speed = 1e160}), roam::Error);
  EXPECT_THROW(follow(m, {}, Mode::walk, {Vec3(0.0)}, {.dt = nan}), roam::Error);
  EXPECT_THROW(follow(m, {}, Mode::walk, {Vec3(0.0)}, {.patience = -1.0}), roam::Error);
}

}  // namespace
