// Wandering by the core alone: where it goes, when it ends, what it refuses.
#include "roam/wander.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "changing_room.h"
#include "messages.h"
#include "motion/look_ahead.h"
#include "roam/world.h"
#include "walker_scenes.h"

namespace {

using namespace roam;

constexpr WalkerSettings person{.radius = 0.3, .height = 1.8};

/// Two rooms of 6 m x 6 m, 3 m high, joined by a door of 1 m.
World two_rooms() {
  Mesh mesh;
  scenes::add_floor(mesh, 0, 0, 12, 6, 0);
  scenes::add_floor(mesh, 0, 0, 12, 6, 3);
  scenes::add_wall(mesh, 0, 0, 12, 0, 0, 3);
  scenes::add_wall(mesh, 0, 6, 12, 6, 0, 3);
  scenes::add_wall(mesh, 0, 0, 0, 6, 0, 3);
  scenes::add_wall(mesh, 12, 0, 12, 6, 0, 3);
  scenes::add_wall(mesh, 6, 0, 6, 2.5, 0, 3);
  scenes::add_wall(mesh, 6, 3.5, 6, 6, 0, 3);
  return World::build({&mesh, 1});
}

/// Ten seconds; before every `period`-th step the caller looks itself, 0: never.
RouteResult wandered(const World& world, int period) {
  Walker walker(world, person, Mode::walk, {3, 3, 0.95});
  Wander wander(walker, {.seconds = 10.0});
  for (int i = 0; !wander.done(); ++i) {
    if (period > 0 && i % period == 0) wander.look();
    if (!wander.done()) wander.advance();
  }
  return wander.result();
}

TEST(Wander, GoesThroughADoorAndEndsWithItsTime) {
  const World world = two_rooms();
  Walker walker(world, person, Mode::walk, {3, 3, 0.95});
  Wander wander(walker, {.seconds = 30.0});
  std::set<int> cells;
  bool beyond = false;
  while (!wander.done()) {
    const Vec3 place = wander.advance().to;
    beyond |= place.x > 7.0;
    cells.insert(static_cast<int>(place.x) * 100 + static_cast<int>(place.y));
  }
  EXPECT_TRUE(beyond);
  EXPECT_GT(cells.size(), 15U);
  EXPECT_EQ(wander.result().outcome, Outcome::reached);
  EXPECT_NEAR(wander.result().simulated, 30.0, 0.02);
  EXPECT_GT(wander.result().least_gap, 0.0);
  EXPECT_EQ(error_of([&] { wander.advance(); }).find("the wandering has ended"), 0U);
}

TEST(Wander, IsTheSameWalkWhoeverLooks) {
  const World world = two_rooms();
  const RouteResult all = wandered(world, 1), some = wandered(world, 2), none = wandered(world, 0);
  for (const RouteResult* other : {&some, &none}) {
    EXPECT_EQ(all.steps, other->steps);
    EXPECT_EQ(all.length, other->length);
    EXPECT_EQ(all.end, other->end);
  }
}

TEST(Wander, CountsNothingOfTheStepBefore) {
  const World world = two_rooms();
  Walker walker(world, person, Mode::fly, {0.32, 3, 1.5});
  const StepReport& before = walker.step({.velocity = {8, 0, 0}}, 0.3);
  ASSERT_LT(before.least_axis_clearance, 0.4);
  Wander wander(walker, {.seconds = 0.01});
  EXPECT_EQ(wander.result().least_axis_clearance, 0.0) << "none is known yet";
  wander.advance();
  EXPECT_GT(wander.result().least_axis_clearance, 0.6);
  EXPECT_TRUE(wander.result().events.empty());
}

TEST(Wander, RefusesWhatCannotBe) {
  const World world = two_rooms();
  Walker walker(world, person, Mode::walk, {3, 3, 0.95});
  const auto refused = [&](const WanderOptions& options) { return error_of([&] { Wander wander(walker, options); }); };
  EXPECT_TRUE(contains(refused({.speed = 0.0}), "speed"));
  EXPECT_TRUE(contains(refused({.speed = std::numeric_limits<double>::infinity()}), "speed"));
  EXPECT_TRUE(contains(refused({.speed = 1e160}), "speed"));
  EXPECT_TRUE(contains(refused({.dt = 1e-7}), "time step"));
  EXPECT_TRUE(contains(refused({.seconds = -1.0}), "time"));
  EXPECT_EQ(refused({}), "");
  walker.set_mode(Mode::ghost);
  EXPECT_TRUE(contains(refused({}), "ghost"));
}

TEST(Wander, LooksElsewhereWhereItGetsStuckAgainAndAgain) {
  // A corridor between two kerbs too high to climb, which a look ahead climbs, and a small room beside it.
  Mesh mesh;
  scenes::add_floor(mesh, -4, -1, 4, 1, 0);
  scenes::add_floor(mesh, -1, 1, 1, 4, 0);
  for (const double side : {-1.0, 1.0}) {
    scenes::add_wall(mesh, 4 * side, -1, 4 * side, 1, 0, 0.45);
    scenes::add_floor(mesh, std::min(4 * side, 20 * side), -1, std::max(4 * side, 20 * side), 1, 0.45);
    scenes::add_wall(mesh, side, 1, 20 * side, 1, 0, 3);
    scenes::add_wall(mesh, side, 1, side, 4, 0, 3);
  }
  scenes::add_wall(mesh, -20, -1, 20, -1, 0, 3);
  scenes::add_wall(mesh, -1, 4, 1, 4, 0, 3);
  const World world = World::build({&mesh, 1});
  Walker walker(world, person, Mode::walk, {0, 0, 0.95});
  Wander wander(walker, {.seconds = 60.0});
  double beside = 0.0;
  while (!wander.done()) beside = std::max(beside, wander.advance().to.y);
  EXPECT_GT(beside, 3.0);
}

TEST(Wander, GoesUpAGentleRampToAnUpperRoom) {
  for (const double slope : {0.045, 0.2}) {
    const double top = 8 * slope;
    Mesh mesh;
    scenes::add_floor(mesh, 0, 0, 6, 6, 0);
    scenes::add_quad(mesh, {6, 2, 0}, {14, 2, top}, {14, 4, top}, {6, 4, 0});
    scenes::add_floor(mesh, 14, 0, 20, 6, top);
    for (const double side : {0.0, 6.0}) scenes::add_wall(mesh, 0, side, 20, side, 0, 5);
    for (const double end : {0.0, 20.0}) scenes::add_wall(mesh, end, 0, end, 6, 0, 5);
    for (const double side : {2.0, 4.0}) scenes::add_wall(mesh, 6, side, 14, side, 0, 5);
    for (const double end : {6.0, 14.0}) {
      scenes::add_wall(mesh, end, 0, end, 2, 0, 5);
      scenes::add_wall(mesh, end, 4, end, 6, 0, 5);
    }
    const World world = World::build({&mesh, 1});
    WalkerSettings stepless = person;
    stepless.step = 0.0;
    for (const WalkerSettings& settings : {person, stepless}) {
      Walker walker(world, settings, Mode::walk, {3, 3, 0.95});
      Wander wander(walker, {.seconds = 120.0});
      double farthest = 0.0;
      while (!wander.done()) farthest = std::max(farthest, wander.advance().to.x);
      EXPECT_GT(farthest, 15.0) << slope << ", step " << settings.step;
    }
  }
}

TEST(Wander, IsNotStuckInASpaceThatSlowsItDown) {
  Mesh corridor;
  scenes::add_box(corridor, {-30, -1, 0}, {30, 1, 3});
  scenes::ChangingRoom room(corridor, true);
  room.limit = 0.25;
  Walker walker(room, person, Mode::walk, {0, 0, 0.95});
  Wander wander(walker, {.speed = 1.4, .seconds = 40.0});
  while (!wander.done()) wander.advance();
  EXPECT_GT(std::abs(walker.position().x), 8.0);
}

TEST(Wander, MayFlyInFromOutside) {
  const World world = two_rooms();
  Walker walker(world, person, Mode::fly, {3, 3, 60});
  EXPECT_FALSE(Wander(walker, {.seconds = 1.0}).done());
}

TEST(Wander, EndsInAnEmptyScene) {
  const World nothing;
  Walker walker(nothing, person, Mode::fly, {3, 3, 60});
  Wander wander(walker, {.seconds = 1.0});
  while (!wander.done()) wander.advance();
}

TEST(FloorSamples, AreAtMostTheWishedNumber) {
  Mesh mesh;
  for (int i = 0; i < 10; ++i) scenes::add_floor(mesh, 2 * i, 0, 2 * i + 1, 1, 0);
  const auto count = [&](std::size_t most) { return floor_samples({&mesh, 1}, most).size(); };
  EXPECT_EQ(count(0), 0U);
  EXPECT_EQ(count(3), 3U);
  EXPECT_EQ(count(std::numeric_limits<std::size_t>::max()), mesh.triangles.size());
}

TEST(WanderStart, IsOnAFloorWithinWalls) {
  const World world = two_rooms();
  const std::optional<WanderStart> start = wander_start(world, person, Mode::walk);
  ASSERT_TRUE(start);
  EXPECT_GT(start->room, 0.0);
  EXPECT_NEAR(start->place.z, 0.95, 0.01);  // not on the roof
  EXPECT_FALSE(wander_start(world, {.radius = 2.0, .height = 8.0}, Mode::fly, {}, 0)) << "no candidate";
  EXPECT_FALSE(wander_start(World(), person, Mode::walk)) << "an empty scene";
  EXPECT_THROW((void)wander_start(world, {.radius = -1.0}, Mode::walk), Error);
}

TEST(WanderStart, IsInAHouseOfSmallRoomsRatherThanInItsGarden) {
  // Four rooms of 4 m x 4 m under one ceiling, joined by doors; the garden wall is 15 m from their middle.
  Mesh mesh;
  scenes::add_floor(mesh, -11, -11, 19, 19, 0);
  scenes::add_floor(mesh, 0, 0, 8, 8, 2.6);
  const auto walls = [&](double low, double high, double top) {
    scenes::add_wall(mesh, low, low, high, low, 0, top);
    scenes::add_wall(mesh, low, high, high, high, 0, top);
    scenes::add_wall(mesh, low, low, low, high, 0, top);
    scenes::add_wall(mesh, high, low, high, high, 0, top);
  };
  walls(-11, 19, 2);
  walls(0, 8, 2.6);
  for (const double corner : {0.0, 4.0}) {  // two doors in each wall between the rooms
    for (const double part : {0.0, 2.5}) {
      const double from = corner + part, to = from + 1.5;
      scenes::add_wall(mesh, from, 4, to, 4, 0, 2.6);
      scenes::add_wall(mesh, 4, from, 4, to, 0, 2.6);
    }
  }
  const World world = scenes::build(mesh);
  std::vector<Vec3> refused;
  const auto refuse = [&](const Vec3& place) { return refused.push_back(place), false; };
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    const std::optional<WanderStart> start = wander_start(world, person, mode);
    ASSERT_TRUE(start);
    EXPECT_TRUE(world.ray(start->place, {0, 0, 3}).hit) << start->place.x << " " << start->place.y;
  }
  EXPECT_FALSE(wander_start(world, person, Mode::walk, {}, 32, {}, refuse));
  std::sort(refused.begin(), refused.end(),
            [](const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  EXPECT_EQ(std::adjacent_find(refused.begin(), refused.end()), refused.end()) << "a candidate is judged once";
}

/// Where ten strides lead to, from the floor at `feet`.
std::vector<Vec3> strides(const World& world, const Vec3& feet, const Vec3& direction,
                          const WalkerSettings& settings = person) {
  std::vector<Vec3> places;
  const Body body = Body::capsule(settings.radius, settings.height);
  wandering::stride_ahead({world, settings, Mode::walk, body}, feet + Vec3(0, 0, 0.5 * settings.height + 1e-3),
                          direction, 10, [&](const Vec3& place, double length) {
                            EXPECT_NEAR(length, 0.5, 1e-9);
                            return places.push_back(place), true;
                          });
  return places;
}

TEST(StrideAhead, GoesUpAndDownASlopeOnTheGround) {
  WalkerSettings stepless = person;
  stepless.step = 0.0;
  for (const double percent : {0.5, 1.0, 2.0, 3.0, 4.0, 4.5, 4.9, 5.5, 8.0, 20.0, 40.0, 70.0, 99.0}) {
    const double slope = percent / 100.0;
    Mesh mesh;
    scenes::add_quad(mesh, {-10, -2, -10 * slope}, {10, -2, 10 * slope}, {10, 2, 10 * slope}, {-10, 2, -10 * slope});
    const World world = World::build({&mesh, 1});
    const double steepness = std::sqrt(1.0 + slope * slope), above = person.radius * (steepness - 1.0);
    for (const WalkerSettings& settings : {person, stepless}) {
      for (const double way : {-1.0, 1.0}) {
        SCOPED_TRACE(testing::Message() << percent << " % " << (way > 0.0 ? "up" : "down") << ", step "
                                        << settings.step);
        const std::vector<Vec3> places = strides(world, {0, 0, above + 1e-4}, {way, 0, 0}, settings);
        EXPECT_EQ(places.size(), 10U);
        for (std::size_t i = 0; i < places.size(); ++i) {
          EXPECT_NEAR(places[i].x, 0.5 * way * double(i + 1), 1e-9);
          EXPECT_NEAR(places[i].z, slope * places[i].x + above + 0.5 * person.height, 4e-3 * steepness);
        }
      }
    }
  }
}

TEST(StrideAhead, GoesThroughADoorAndUnderALowCeilingThatFalls) {
  Mesh door, tunnel;
  scenes::add_floor(door, -10, -2, 10, 2, 0);
  scenes::add_floor(door, -10, -2, 10, 2, 3);
  scenes::add_wall(door, 2, -2, 2, 2, 2, 3);
  scenes::add_floor(tunnel, -10, -2, 10, 2, 0);
  scenes::add_quad(tunnel, {-10, -2, 2.6}, {10, -2, 1.9}, {10, 2, 1.9}, {-10, 2, 2.6});
  for (const Mesh* mesh : {&door, &tunnel}) {
    const std::vector<Vec3> places = strides(World::build({mesh, 1}), {0, 0, 0}, {1, 0, 0});
    EXPECT_EQ(places.size(), 10U);
    ASSERT_FALSE(places.empty());
    EXPECT_NEAR(places.back().x, 5.0, 1e-9);
  }
}

TEST(WanderStart, IsInALongRoomRatherThanInASmallOneWithMoreFloor) {
  // 4 m x 4 m, empty, beside 4 m x 14 m with tables that leave aisles of 0.8 m.
  Mesh mesh;
  scenes::add_box(mesh, {0, 0, 0}, {4, 4, 2.6});
  scenes::add_box(mesh, {10, 0, 0}, {14, 14, 2.6});
  for (double y = 0.8; y < 13.0; y += 1.8) scenes::add_box(mesh, {10.8, y, 0}, {13.2, y + 1, 0.9});
  const std::optional<WanderStart> start = wander_start(scenes::build(mesh), person, Mode::walk);
  ASSERT_TRUE(start);
  EXPECT_GT(start->place.x, 10.0);
}

TEST(WanderStart, IsNotOnARoofThatHasMoreRoom) {
  Mesh mesh;
  // The roof of a crawl space, and a yard beside it.
  scenes::add_floor(mesh, -15, -15, 15, 15, -18.8);
  scenes::add_floor(mesh, -15, -15, 15, 15, -20);
  scenes::add_floor(mesh, 20, -3, 26, 3, -20);
  const std::optional<WanderStart> start = wander_start(scenes::build(mesh), person, Mode::walk);
  ASSERT_TRUE(start);
  EXPECT_FALSE(start->on_top);
  EXPECT_GT(start->place.x, 20.0);
}

TEST(WanderStart, IsInTheOpenRatherWhereAWallIsInSight) {
  // A yard with a wall on one side, and far off a larger field.
  Mesh mesh;
  scenes::add_floor(mesh, 0, 0, 12, 12, 0);
  scenes::add_wall(mesh, 12, 0, 12, 12, 0, 2);
  scenes::add_floor(mesh, 100, 0, 120, 20, 0);
  const std::optional<WanderStart> start = wander_start(scenes::build(mesh), person, Mode::walk);
  ASSERT_TRUE(start);
  EXPECT_LT(start->place.x, 12.0);
}

TEST(WanderStart, IsLookedForOnceOnEachFloorOfAHugeScene) {
  roam::Mesh huge;
  scenes::add_floor(huge, -1e9, -1e9, 1e9, 1e9, 1e9);
  scenes::add_floor(huge, -1e9, -1e9, 1e9, 1e9, -1e9);
  const World world = scenes::build(huge);
  int looked = 0;
  const auto count = [&] { return ++looked > 0; };
  (void)wander_start(world, person, Mode::walk, {}, 4, count);
  EXPECT_LE(looked, 2 * 4 * 4);
}

TEST(WanderStart, EndsWhenGoesOnSaysNo) {
  int asked = 0;
  EXPECT_THROW((void)wander_start(two_rooms(), person, Mode::walk, {}, 32, [&] { return ++asked < 5; }), Cancelled);
  EXPECT_EQ(asked, 5);
}

}  // namespace
