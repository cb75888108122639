// Where a person finds himself as the viewer opens a scene: in a house, on the land, or before an object.
#include "view/start.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "box_made.h"
#include "roam/generate.h"
#include "roam/wander.h"
#include "roam/world.h"
#include "walker_scenes.h"

namespace {

using namespace roam;
using namespace roam::app;

/// A closed ball, stretched to `half`, with its fronts outside.
Mesh hull(const Vec3& centre, const Vec3& half) {
  constexpr int rings = 24, sides = 48;
  Mesh mesh{.name = "hull"};
  const auto at = [&](int ring, int side) {
    const double polar = std::numbers::pi * ring / rings, around = 2.0 * std::numbers::pi * (side % sides) / sides;
    return centre +
           half * Vec3(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar));
  };
  for (int i = 0; i < rings; ++i) {
    for (int k = 0; k < sides; ++k) scenes::add_quad(mesh, at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
  }
  return mesh;
}

/// Two rooms of 5 x 6 x 2.6 m with thick walls and a gable roof on top.
Mesh house() {
  Mesh mesh{.name = "house"};
  scenes::add_room(mesh, {0, 0, 0}, {10.6, 6.4, 3}, true);
  scenes::add_room(mesh, {0.2, 0.2, 0.2}, {5.2, 6.2, 2.8});
  scenes::add_room(mesh, {5.4, 0.2, 0.2}, {10.4, 6.2, 2.8});
  scenes::add_quad(mesh, {-0.3, -0.3, 3}, {10.9, -0.3, 3}, {10.9, 3.2, 4.6}, {-0.3, 3.2, 4.6});
  scenes::add_quad(mesh, {-0.3, 3.2, 4.6}, {10.9, 3.2, 4.6}, {10.9, 6.7, 3}, {-0.3, 6.7, 3});
  return mesh;
}

StartPlace start_in(const std::vector<Mesh>& meshes, Mode mode = Mode::walk) {
  return find_start(World::build(meshes), {}, mode, meshes, [] { return true; });
}

Vec3 ahead(const Pose& pose) {
  const double yaw = pose.yaw * std::numbers::pi / 180.0, pitch = pose.pitch * std::numbers::pi / 180.0;
  return {std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch)};
}

/// Expects a body outside of the box that sees all of it.
void expect_framed(const StartPlace& start, const Box& box, Mode mode = Mode::fly) {
  EXPECT_EQ(start.mode, mode);
  EXPECT_NE(start.note, "");
  const Body body = Body::capsule(0.3, 1.8);
  Mesh block;
  scenes::add_room(block, box.lower, box.upper, true);
  if (mode == Mode::fly) {
    EXPECT_GT(World::build({&block, 1}).clearance(body, start.pose.position, 10.0).distance, 0.0);
  }
  const WalkerSettings person;
  const Vec3 eye = start.pose.position + Vec3(0.0, 0.0, person.eye - 0.5 * person.height);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p(corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                 corner & 4 ? box.upper.z : box.lower.z);
    EXPECT_GT(glm::dot(glm::normalize(p - eye), ahead(start.pose)), std::cos(std::numbers::pi / 6.0));
  }
}

TEST(StartPlace, IsOutsideOfAClosedHullEvenIfTheBodyFitsInside) {
  const Vec3 centre(100, 50, 3), half(5, 2, 3);
  expect_framed(start_in({hull(centre, half)}), {centre - half, centre + half});
}

TEST(StartPlace, IsBeforeAnObjectThatIsSmallerThanTheBody) {
  for (const double size : {0.008, 0.1, 0.5, 1.0, 2.5}) {
    Mesh block{.name = "block"};
    scenes::add_room(block, {0, 0, 0}, {size, size, size}, true);
    const StartPlace start = start_in({block});
    expect_framed(start, {{0, 0, 0}, {size, size, size}}, size < 0.2 ? Mode::ghost : Mode::fly);
    EXPECT_LT(glm::distance(start.pose.position, Vec3(0.0)), 2.0 + 2.0 * size) << "as near as the body can";
  }
}

TEST(StartPlace, IsInAHouseAndNotOnItsRoof) {
  for (const bool with_ground : {false, true}) {
    std::vector<Mesh> meshes{house()};
    if (with_ground)
      meshes.push_back({"ground", {{-60, -60, 0}, {60, -60, 0}, {60, 60, 0}, {-60, 60, 0}}, {{0, 1, 2}, {0, 2, 3}}});
    const StartPlace start = start_in(meshes);
    EXPECT_EQ(start.mode, Mode::walk);
    EXPECT_EQ(start.note, "");
    const Vec3& p = start.pose.position;
    const bool in_a_room = p.x > 0.2 && p.x < 10.4 && p.y > 0.2 && p.y < 6.2;
    EXPECT_TRUE(in_a_room || with_ground) << p.x << " " << p.y;
    EXPECT_NEAR(p.z, in_a_room ? 1.1 : 0.9, 0.1);
  }
}

TEST(StartPlace, IsInTheStreetAndNeitherOnNorInTheBlocks) {
  std::vector<Mesh> meshes{
      {"ground", {{-40, -40, 0}, {90, -40, 0}, {90, 90, 0}, {-40, 90, 0}}, {{0, 1, 2}, {0, 2, 3}}}};
  for (const double x : {0.0, 30.0}) {
    for (const double y : {0.0, 30.0}) {
      meshes.push_back({.name = "block"});
      scenes::add_room(meshes.back(), {x, y, 0}, {x + 20, y + 20, 12}, true);
    }
  }
  const StartPlace start = start_in(meshes);
  EXPECT_EQ(start.mode, Mode::walk);
  const Vec3& p = start.pose.position;
  EXPECT_NEAR(p.z, 0.9, 0.1);
  EXPECT_FALSE(std::fmod(p.x + 40, 30) > 10 && std::fmod(p.y + 40, 30) > 10 && p.x > 0 && p.x < 50 && p.y > 0 &&
               p.y < 50);
}

TEST(StartPlace, IsOnTheGroundOfATerrainWithAViewOverIt) {
  const auto meshes = generate::collect(generate::terrain({.triangles = 20'000}));
  const World world = World::build(meshes);
  const StartPlace start = find_start(world, {}, Mode::walk, meshes, [] { return true; });
  EXPECT_EQ(start.mode, Mode::walk);
  const Impact ground = world.ray(start.pose.position, {0, 0, -2});
  ASSERT_TRUE(ground.hit);
  EXPECT_NEAR(2.0 * ground.time, 0.9, 0.3);
  EXPECT_FALSE(world.ray(start.pose.position, 30.0 * ahead(start.pose)).hit);
}

TEST(StartPlace, IsOnLandThatHasABottom) {
  Mesh slab{.name = "land"};
  scenes::add_room(slab, {0, 0, -20}, {500, 500, 0}, true);
  EXPECT_EQ(start_in({slab}).mode, Mode::walk);
}

TEST(StartPlace, IsInARoomWhoseWallsAreSheets) {
  Mesh room{.name = "scan"};
  scenes::add_room(room, {0, 0, 0}, {5, 4, 2.5});
  const StartPlace start = start_in({room});
  EXPECT_EQ(start.mode, Mode::walk);
  EXPECT_NEAR(start.pose.position.z, 0.9, 0.1);
}

TEST(StartPlace, IsInALongRoomFullOfFurnitureRatherThanInASmallOne) {
  Mesh mesh{.name = "flat"};
  scenes::add_room(mesh, {0, 0, 3}, {4, 4, 5.6});
  scenes::add_room(mesh, {0, 0, 0}, {4, 10, 2.6});
  for (int i = 1; i < 6; ++i) {  // counters, with a passage at one end
    const double x = i % 2 == 0 ? 0.8 : 0.0, y = 1.6 * i;
    scenes::add_room(mesh, {x, y, 0}, {x + 3.2, y + 0.6, 0.9}, true);
  }
  const StartPlace start = start_in({mesh});
  EXPECT_EQ(start.mode, Mode::walk);
  EXPECT_LT(start.pose.position.z, 1.5) << "downstairs";
  const World world = World::build({&mesh, 1});
  const Vec3 eye = start.pose.position + Vec3(0, 0, 0.7);
  EXPECT_GT(world.ray(eye, 20.0 * ahead(start.pose)).time * 20.0, 4.0);
}

TEST(StartPlace, LooksAlongAHallFromAnEyeNearTheFloor) {
  Mesh mesh{.name = "hall"};
  scenes::add_room(mesh, {0, 0, 0}, {4, 20, 3});
  const WalkerSettings ball = WalkerSettings::sphere(0.1);
  const StartPlace start = find_start(World::build({&mesh, 1}), ball, Mode::walk, {&mesh, 1}, [] { return true; });
  EXPECT_EQ(start.mode, Mode::walk);
  EXPECT_GT(std::abs(ahead(start.pose).y), 0.9) << start.pose.yaw;
}

TEST(StartPlace, LooksPastASlit) {
  // A room of 4 m x 6 m. Towards +x its wall has a slit of 10 cm, and 18 m behind that is another wall.
  Mesh mesh{.name = "room"};
  const auto wall = [&](const Vec3& a, const Vec3& b) {
    scenes::add_quad(mesh, a, {b.x, b.y, a.z}, b, {a.x, a.y, b.z});
  };
  wall({2, -3, 0}, {2, -0.05, 2.6});
  wall({2, 0.05, 0}, {2, 3, 2.6});
  wall({20, -3, 0}, {20, 3, 2.6});
  wall({-2, -3, 0}, {-2, 3, 2.6});
  wall({-2, 3, 0}, {20, 3, 2.6});
  wall({-2, -3, 0}, {20, -3, 2.6});
  const OpenDirection open = open_direction(World::build({&mesh, 1}), {0, 0, 1.6}, 30.0);
  EXPECT_GT(std::abs(std::sin(open.yaw * std::numbers::pi / 180.0)), 0.9) << "along the room: " << open.yaw;
  EXPECT_NEAR(open.length, 3.0, 0.3);
}

TEST(OpenDirection, IsTheOneWithoutAnEndAndWithinReach) {
  // A yard, closed but towards +y, in a wide land.
  Mesh mesh{.name = "yard"};
  scenes::add_quad(mesh, {-100, -100, 0}, {100, -100, 0}, {100, 100, 0}, {-100, 100, 0});
  scenes::add_room(mesh, {-4, -4, 0}, {-3, 12, 3}, true);
  scenes::add_room(mesh, {3, -4, 0}, {4, 12, 3}, true);
  scenes::add_room(mesh, {-4, -4, 0}, {4, -3, 3}, true);
  const World world = World::build({&mesh, 1});
  const OpenDirection far = open_direction(world, {0, 0, 1.6}, 1000.0), near = open_direction(world, {0, 0, 1.6}, 15.0);
  EXPECT_EQ(far.yaw, 90.0);
  EXPECT_EQ(near.yaw, 90.0);
  EXPECT_NEAR(far.length, 80.0, 4.0) << "to the end of the land";
  EXPECT_NEAR(near.length, 13.0, 1.0);
  EXPECT_EQ(open_direction(World(), {0, 0, 1.6}, 15.0).length, 0.0) << "an empty scene";
  Mesh wide;
  wide.vertices = {{-4e6, -4e6, 0}, {4e6, -4e6, 0}, {0, 4e6, 0}};
  wide.triangles = {{0, 1, 2}};
  EXPECT_GT(open_direction(World::build({&wide, 1}), {0, 0, 1.6}, 1e300).length, 9e5);
}

}  // namespace
