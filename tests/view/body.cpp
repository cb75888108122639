// What roam view says of what holds the body, where it lets it start, and how it leads it along a path.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <sstream>

#include "changing_room.h"
#include "roam/error.h"
#include "roam/path_file.h"
#include "roam/world.h"
#include "view/hold.h"
#include "view/replay.h"
#include "view/start.h"

namespace {

using namespace roam;
using namespace roam::app;

/// A wall, a floor or a door as a rectangle.
Mesh rectangle(const std::string& name, const Vec3& corner, const Vec3& along, const Vec3& up) {
  return {name, {corner, corner + along, corner + along + up, corner + up}, {{0, 1, 2}, {0, 2, 3}}};
}

/// A hall of 20 x 10 x 3 m on the floor z = 0, with a wall across it at x = 10 that has an opening `width` wide.
World hall(double width) {
  const double side = 5.0 - 0.5 * width;
  const Vec3 up(0, 0, 3);
  return World::build(std::vector<Mesh>{
      rectangle("floor", {0, -5, 0}, {20, 0, 0}, {0, 10, 0}), rectangle("ceiling", {0, -5, 3}, {20, 0, 0}, {0, 10, 0}),
      rectangle("left", {0, 5, 0}, {20, 0, 0}, up), rectangle("right", {0, -5, 0}, {20, 0, 0}, up),
      rectangle("back", {0, -5, 0}, {0, 10, 0}, up), rectangle("front", {20, -5, 0}, {0, 10, 0}, up),
      rectangle("Door_12", {10, -5, 0}, {0, side, 0}, up), rectangle("Door_12", {10, 5 - side, 0}, {0, side, 0}, up)});
}

TEST(Hold, NamesTheWallAndMeasuresItsOpening) {
  const World world = hall(0.5);
  Walker walker(world, {}, Mode::walk, {8, 0, 0.95});
  Hold hold;
  const Vec3 wish(1.4, 0, 0);
  for (int i = 0; i < 240; ++i) hold.take(walker, wish, walker.step({.velocity = wish}, 1.0 / 60.0).elapsed);
  EXPECT_EQ(hold.told().text, "blocked by Door_12: opening 0.50 m for a body of 0.60 m");
  EXPECT_TRUE(hold.told().warning);
  for (int i = 0; i < 60; ++i) hold.take(walker, {}, walker.step({}, 1.0 / 60.0).elapsed);
  EXPECT_EQ(hold.told().text, "");
}

TEST(Hold, ComparesWhatIsTooLowWithTheHeight) {
  std::vector<Mesh> meshes{rectangle("floor", {0, -5, 0}, {20, 0, 0}, {0, 10, 0}),
                           rectangle("beam", {10, -5, 0.9}, {0, 10, 0}, {0, 0, 3})};
  const World world = World::build(meshes);
  for (const double radius : {0.3, 0.5}) {  // narrower than the opening is high, and wider
    Walker walker(world, {.radius = radius}, Mode::walk, {8, 0, 0.95});
    Hold hold;
    const Vec3 wish(1.4, 0, 0);
    for (int i = 0; i < 240; ++i) hold.take(walker, wish, walker.step({.velocity = wish}, 1.0 / 60.0).elapsed);
    // It has crouched to 1.1 m.
    EXPECT_EQ(hold.told().text, "blocked by beam: opening 0.90 m high for a body of 1.10 m");
  }
}

TEST(Hold, TellsWhyTheBodyIsCrouched) {
  const World world = World::build(std::vector<Mesh>{rectangle("Table_3", {-1, -1, 1.3}, {2, 0, 0}, {0, 2, 0}),
                                                     rectangle("ground", {-50, -50, 0}, {100, 0, 0}, {0, 100, 0})});
  Walker walker(world, {}, Mode::walk, {0, 0, 0.95});
  ASSERT_TRUE(walker.crouched());
  Hold hold;
  const auto step = [&](const Vec3& wish, bool crouch) {
    hold.take(walker, wish, walker.step({.velocity = wish, .crouch = crouch}, 1.0 / 60.0).elapsed);
  };
  step({}, false);
  EXPECT_EQ(hold.told().text, "crouched under Table_3: the headroom is 1.30 m, and the body 1.80 m high");
  EXPECT_FALSE(hold.told().warning);
  for (int i = 0; i < 120; ++i) step({1.4, 0, 0}, true);
  ASSERT_TRUE(walker.crouched());
  EXPECT_EQ(hold.told().text, "") << "it could stand here";
  for (int i = 0; i < 60; ++i) step({}, false);
  ASSERT_FALSE(walker.crouched());
  EXPECT_EQ(hold.told().text, "");
}

TEST(Hold, TellsOfNothingBelow) {
  const World world = hall(0.5);
  Walker walker(world, {}, Mode::walk, {8, 0, -30});
  Hold hold;
  for (int i = 0; i < 30; ++i) hold.take(walker, {}, walker.step({}, 1.0 / 60.0).elapsed);
  EXPECT_EQ(hold.told().text, "held: there is nothing below to stand on");
}

TEST(Hold, TellsOfAFall) {
  const World world = World::build(std::vector<Mesh>{rectangle("ledge", {-5, -5, 4}, {10, 0, 0}, {0, 10, 0}),
                                                     rectangle("ground", {-50, -50, 0}, {100, 0, 0}, {0, 100, 0})});
  Walker walker(world, {}, Mode::walk, {0, 0, 4.95});
  Hold hold;
  std::string told;
  for (int i = 0; i < 420; ++i) {
    hold.take(walker, {1.4, 0, 0}, walker.step({.velocity = {1.4, 0, 0}}, 1.0 / 60.0).elapsed);
    if (hold.told().text != told && !hold.told().text.empty()) told = hold.told().text;
  }
  EXPECT_EQ(told, "fell 4.0 m");
}

TEST(Hold, TellsOfGroundThatIsTooSteep) {
  const double foot = 4.0 - 10.0 * std::tan(46.0 * std::numbers::pi / 180.0);
  const World world = World::build(std::vector<Mesh>{rectangle("ledge", {-5, -5, 4}, {10, 0, 0}, {0, 10, 0}),
                                                     rectangle("ramp", {5, -5, 4}, {10, 0, foot - 4}, {0, 10, 0})});
  Walker walker(world, {}, Mode::walk, {4, 0, 4.95});
  Hold hold;
  for (int i = 0; i < 420 && !walker.report().has(EventKind::fell); ++i) {
    hold.take(walker, {1.4, 0, 0}, walker.step({.velocity = {1.4, 0, 0}}, 1.0 / 60.0).elapsed);
  }
  EXPECT_EQ(hold.told().text, "fell: the ground is too steep to stand on");
}

TEST(Hold, TellsWhatASlowedBodyWaitsFor) {
  scenes::ChangingRoom room(rectangle("ground", {-50, -50, 0}, {100, 0, 0}, {0, 100, 0}), true);
  room.limit = 0.5;
  Walker walker(room, {}, Mode::walk, {0, 0, 0.95});
  Hold hold;
  hold.take(walker, {1.4, 0, 0}, walker.step({.velocity = {1.4, 0, 0}}, 1.0 / 60.0).elapsed);
  EXPECT_EQ(hold.told().text, "slowed: loading ahead");
  EXPECT_EQ(hold.told("3 tiles to come from a.org").text, "slowed: 3 tiles to come from a.org");
}

TEST(Hold, TellsOfABodyThatDoesNotFit) {
  const World world = hall(0.5);
  Walker walker(world, {}, Mode::walk, {8, 5.0, 0.95});  // its centre is on a triangle: held, see Walker::place
  Hold hold;
  hold.take(walker, {}, 0.0);
  EXPECT_EQ(hold.told().text, "held: the body does not fit here");
}

// --------------------------------------------------------------------------------------------------------- start

TEST(Start, IsInsideOnTheFloorLookingIntoTheRoom) {
  const World world = hall(2.0);
  const StartPlace start = find_start(world, {}, Mode::walk, {}, [] { return true; });
  EXPECT_EQ(start.mode, Mode::walk);
  EXPECT_EQ(start.note, "");
  EXPECT_GT(start.pose.position.z, 0.9);
  EXPECT_LT(start.pose.position.z, 1.1);
  EXPECT_GT(world.clearance(Body::capsule(0.3, 1.8), start.pose.position, 1.0).distance, 0.0);
  const double yaw = start.pose.yaw * 3.14159265358979 / 180.0;
  const Impact sight = world.ray(start.pose.position, 20.0 * Vec3(std::cos(yaw), std::sin(yaw), 0.0));
  EXPECT_GT(sight.time * 20.0, 8.0);
}

TEST(Start, FliesWhereThereIsNoFloor) {
  const World world = World::build(std::vector<Mesh>{rectangle("cliff", {0, 0, 0}, {10, 0, 0}, {0, 1, 10})});
  const StartPlace start = find_start(world, {}, Mode::walk, {}, [] { return true; });
  EXPECT_EQ(start.mode, Mode::fly);
  EXPECT_NE(start.note, "");
  EXPECT_GT(world.clearance(Body::capsule(0.3, 1.8), start.pose.position, 1.0).distance, 0.0);
}

TEST(Start, SeesWhatThereIsWhereThereIsNoFloor) {
  // Looked at from above and level, this wall is a line, or not in the picture at all.
  const World world = World::build(std::vector<Mesh>{Mesh{"wall", {{0, 0, 0}, {0, 5, 0}, {0, 0, 5}}, {{0, 1, 2}}}});
  const StartPlace start = find_start(world, {}, Mode::walk, {}, [] { return true; });
  EXPECT_EQ(start.mode, Mode::fly);
  const double yaw = start.pose.yaw * 3.14159265358979 / 180.0, pitch = start.pose.pitch * 3.14159265358979 / 180.0;
  const Vec3 ahead(std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch));
  const double most = glm::dot(ahead, glm::normalize(Vec3(0, 1.67, 1.67) - start.pose.position));
  EXPECT_GT(most, std::cos(0.4));
  EXPECT_GT(std::abs(start.pose.position.x), 0.5);
}

TEST(Start, CanBeEnded) {
  const World world = hall(2.0);
  EXPECT_THROW(static_cast<void>(find_start(world, {}, Mode::walk, {}, [] { return false; })), Cancelled);
}

TEST(Overview, SeesAllOfTheBox) {
  const Box box{{100, 200, 0}, {300, 260, 30}};
  const Pose pose = overview(box, 60.0);
  const double yaw = pose.yaw * 3.14159265358979 / 180.0, pitch = pose.pitch * 3.14159265358979 / 180.0;
  const Vec3 ahead(std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch));
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p(corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                 corner & 4 ? box.upper.z : box.lower.z);
    EXPECT_GT(glm::dot(glm::normalize(p - pose.position), ahead), std::cos(3.14159265358979 / 6.0));
  }
}

// -------------------------------------------------------------------------------------------------------- replay

TEST(Replay, GoesTheWayOfARouteAndLooksAhead) {
  const World world = hall(2.0);
  std::istringstream text("2 0 0.3\n18 0 0.3\n18 3 0.3\n");
  const std::vector<Waypoint> path = read_path(text, "p");
  WalkerSettings settings = WalkerSettings::sphere(0.3);
  Walker a(world, settings, Mode::walk, path[0].position);
  Walker b(world, settings, Mode::walk, path[0].position);
  const RouteResult expected = follow(a, positions(path));
  Replay replay(b, path, {});
  double yaw_at_first = 10.0;
  while (const StepReport* report = replay.advance()) {
    const Replay::Gaze gaze = replay.gaze(report->elapsed);
    if (yaw_at_first > 9.0) yaw_at_first = gaze.yaw;
  }
  EXPECT_EQ(replay.result().outcome, Outcome::reached);
  EXPECT_EQ(replay.result().steps, expected.steps);
  EXPECT_EQ(replay.result().end, expected.end);
  EXPECT_NEAR(yaw_at_first, 0.0, 1e-9);
  EXPECT_GT(replay.gaze(0.1).yaw, 0.8);
}

TEST(Replay, LooksAsThePathWasRecorded) {
  const World world = hall(2.0);
  // OpenSceneGraph's camera that looks along +x, up +z.
  std::istringstream text("0 2 0 0.3 0.5 -0.5 -0.5 0.5\n1 3 0 0.3 0.5 -0.5 -0.5 0.5\n");
  const std::vector<Waypoint> path = read_path(text, "p");
  Walker walker(world, WalkerSettings::sphere(0.3), Mode::fly, path[0].position);
  Replay replay(walker, path, {});
  const Replay::Gaze gaze = replay.gaze(0.0);
  EXPECT_NEAR(gaze.yaw, 0.0, 1e-9);
  EXPECT_NEAR(gaze.pitch, 0.0, 1e-9);
}

/// A ball that has begun to follow a path.
struct Replayed {
  World world = hall(2.0);
  Walker walker{world, WalkerSettings::sphere(0.3), Mode::walk, {2, 0, 0.3}};
  Replay replay{walker, path(), {}};

  Replayed() { EXPECT_NE(replay.advance(), nullptr); }

  static std::vector<Waypoint> path() {
    std::istringstream text("2 0 0.3\n18 0 0.3\n");
    return read_path(text, "p");
  }
};

TEST(Replay, EndsWhereThePersonTakesOver) {
  Replayed r;
  r.walker.set_mode(Mode::fly);
  EXPECT_EQ(r.replay.advance(), nullptr);
  EXPECT_TRUE(r.replay.left());
}

TEST(Replay, EndsWhereThePersonPutsTheBodyElsewhere) {
  Replayed r;
  r.walker.place({15, 0, 0.3});
  r.replay.go_on_here();
  ASSERT_NE(r.replay.advance(), nullptr) << "a lesson may put it elsewhere";
  r.walker.place({17.9, 0, 0.3});
  EXPECT_EQ(r.replay.advance(), nullptr);
  EXPECT_TRUE(r.replay.left());
  EXPECT_FALSE(r.replay.ended());
}

}  // namespace
