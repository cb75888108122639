// Rooms, the necks between them, paths that miss none of them, and the regions that they make.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "train_shells.h"
#include "training/places/places.h"
#include "training/places/regions.h"

namespace roam::training {
namespace {

using shells::Look;

constexpr double door = 0.7, narrow_door = 0.5, wide_door = 0.6;

/// A gallery of 12 by 2.4 m with a door in its middle, and two grottos behind narrower ones.
Mesh gallery() {
  Mesh mesh;
  scenes::add_floor(mesh, 0, -2.5, 12, 2.4, 0.0);
  scenes::add_floor(mesh, 0, -2.5, 12, 2.4, 3.0);
  shells::add_wall_with_door(mesh, 0, 4, 0, 2.5, narrow_door);
  shells::add_wall_with_door(mesh, 4, 12, 0, 9.0, wide_door);
  scenes::add_wall(mesh, 0, 2.4, 12, 2.4, 0.0, 3.0);
  scenes::add_wall(mesh, 0, -2.5, 12, -2.5, 0.0, 3.0);
  scenes::add_wall(mesh, 0, -2.5, 0, 2.4, 0.0, 3.0);
  scenes::add_wall(mesh, 12, -2.5, 12, 2.4, 0.0, 3.0);
  scenes::add_wall(mesh, 6, 0, 6, 1.2 - 0.5 * door, 0.0, 3.0);
  scenes::add_wall(mesh, 6, 1.2 + 0.5 * door, 6, 2.4, 0.0, 3.0);
  scenes::add_wall(mesh, 5, -2.5, 5, 0, 0.0, 3.0);
  return mesh;
}

/// 500 m2, and a grotto of 1 m2 behind a door of 0.5 m.
Mesh hall_with_grotto() {
  Mesh mesh;
  scenes::add_floor(mesh, 0, 0, 25, 20, 0.0);
  scenes::add_floor(mesh, 12, -1, 13, 0, 0.0);
  scenes::add_wall(mesh, 0, 20, 25, 20, 0.0, 3.0);
  scenes::add_wall(mesh, 0, 0, 0, 20, 0.0, 3.0);
  scenes::add_wall(mesh, 25, 0, 25, 20, 0.0, 3.0);
  shells::add_wall_with_door(mesh, 0, 25, 0, 12.5, 0.5);
  scenes::add_wall(mesh, 12, -1, 13, -1, 0.0, 3.0);
  scenes::add_wall(mesh, 12, -1, 12, 0, 0.0, 3.0);
  scenes::add_wall(mesh, 13, -1, 13, 0, 0.0, 3.0);
  return mesh;
}

const Component& scene_of(const Look& look) {
  const auto inside =
      std::find_if(look.components.begin(), look.components.end(), [](const Component& c) { return c.inside; });
  if (inside == look.components.end()) throw Error("nothing is inside");
  return *inside;
}

void expect_four_rooms(const Look& look, double radius) {
  const Component& scene = scene_of(look);
  const Rooms found = find_rooms(look.survey, look.measure, look.tree, scene, radius);
  EXPECT_EQ(found.rooms.size(), 4u);
  ASSERT_EQ(found.necks.size(), 3u);
  // The lattice sees a thin door from up to half a spacing before it.
  const double widths[] = {door, wide_door, narrow_door};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(found.necks[i].rooms.size(), 2u);
    EXPECT_GT(found.necks[i].radius, 0.5 * widths[i] - 0.1);
    EXPECT_LT(found.necks[i].radius, 0.5 * widths[i] + 0.03);
  }
  EXPECT_EQ(found.dead_ends(), 2u);
  // Each place is in one room or one neck.
  std::multiset<ways::NodeId> all;
  for (const Room& r : found.rooms) all.insert(r.nodes.begin(), r.nodes.end());
  for (const Neck& n : found.necks) all.insert(n.nodes.begin(), n.nodes.end());
  EXPECT_EQ(std::vector<ways::NodeId>(all.begin(), all.end()), scene.nodes);
}

TEST(TrainRooms, AGalleryWithADoorAndTwoGrottosHasFourRoomsAndThreeNecks) {
  const Look look(gallery());
  expect_four_rooms(look, 0.4);
}

TEST(TrainRooms, TheyAreFoundWithoutARadius) {
  const Look look(gallery());
  expect_four_rooms(look, any_radius);
}

TEST(TrainRooms, ASmallRadiusSeesOneRoom) {
  const Look look(gallery());
  const Rooms found = find_rooms(look.survey, look.measure, look.tree, scene_of(look), 0.15);
  EXPECT_EQ(found.rooms.size(), 1u);
  EXPECT_TRUE(found.necks.empty());
  EXPECT_EQ(found.dead_ends(), 0u);
}

TEST(TrainRooms, ARadiusBetweenTheDoorsSeesTwoGrottos) {
  // Between lattice lines a door looks up to half a spacing narrower.
  const Look look(gallery(), 0.05);
  const Rooms found = find_rooms(look.survey, look.measure, look.tree, scene_of(look), 0.322);
  EXPECT_EQ(found.rooms.size(), 3u);
  EXPECT_EQ(found.necks.size(), 2u);
}

TEST(TrainRooms, ARoomThatNoBodyOfThatRadiusFitsIntoIsARoomBehindANeck) {
  const Look look(hall_with_grotto());
  const Rooms found = find_rooms(look.survey, look.measure, look.tree, scene_of(look), 0.7);
  ASSERT_EQ(found.rooms.size(), 2u);
  EXPECT_LT(look.tree.node(found.rooms[1].widest).clearance, 0.55F);
  ASSERT_EQ(found.necks.size(), 1u);
}

TEST(TrainRooms, MovedTurnedAndReorderedTheyAreTheSame) {
  Mesh mesh = gallery();
  std::reverse(mesh.triangles.begin(), mesh.triangles.end());
  expect_four_rooms(Look(mesh), 0.4);
  const double c = std::cos(0.4), s = std::sin(0.4);
  for (Vec3& v : mesh.vertices) v = {c * v.x - s * v.y - 13739.0, s * v.x + c * v.y + 253.0, v.z + 182.0};
  expect_four_rooms(Look(mesh), 0.4);
  expect_four_rooms(Look(mesh), any_radius);
}

TEST(TrainPaths, AGrottoOfTwoThousandthsOfTheFloorIsOnAPathForEverySeed) {
  const Look look(hall_with_grotto());
  const Component& scene = scene_of(look);
  const Rooms rooms = find_rooms(look.survey, look.measure, look.tree, scene);
  ASSERT_GE(rooms.rooms.size(), 2u);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto paths = draw_paths(look.tree, scene, rooms, 0, seed);
    EXPECT_EQ(paths.size(), 5u);
    const bool met = std::any_of(paths.begin(), paths.end(), [&](const Ends& ends) {
      const auto way = look.tree.way(ends.from, ends.to);
      return std::any_of(way.begin(), way.end(), [&](ways::NodeId id) { return look.tree.node(id).place.y < -0.3; });
    });
    EXPECT_TRUE(met) << "seed " << seed;
  }
}

TEST(TrainPaths, EveryRoomIsOnOneAndEveryNeckIsCrossed) {
  const Look look(gallery());
  const Component& scene = scene_of(look);
  const Rooms rooms = find_rooms(look.survey, look.measure, look.tree, scene);
  for (const int count : {0, 1, 2, 7}) {
    const auto paths = draw_paths(look.tree, scene, rooms, count, 3);
    EXPECT_EQ(paths.size(), count == 0 ? 5u : static_cast<std::size_t>(count));
    std::set<ways::NodeId> met;
    for (const Ends& ends : paths) {
      EXPECT_NE(ends.from, ends.to);
      const auto way = look.tree.way(ends.from, ends.to);
      met.insert(way.begin(), way.end());
    }
    const auto meets = [&](const std::vector<ways::NodeId>& nodes) {
      return std::any_of(nodes.begin(), nodes.end(), [&](ways::NodeId id) { return met.count(id) == 1; });
    };
    for (const Room& r : rooms.rooms) EXPECT_TRUE(meets(r.nodes)) << count;
    for (const Neck& n : rooms.necks) EXPECT_TRUE(meets(n.nodes)) << count;
  }
}

TEST(TrainPaths, EndsStandWhereItIsWide) {
  const Look look(hall_with_grotto());
  const Component& scene = scene_of(look);
  const Rooms rooms = find_rooms(look.survey, look.measure, look.tree, scene);
  for (const Ends& ends : draw_paths(look.tree, scene, rooms, 20, 1)) {
    for (const ways::NodeId end : {ends.from, ends.to}) {
      const ways::Node& node = look.tree.node(end);
      EXPECT_GT(node.clearance, node.place.y < 0.0 ? 0.4F : 0.79F);
    }
  }
}

TEST(TrainPaths, TheSameSeedDrawsTheSameAndAnotherSeedOthers) {
  const Look look(hall_with_grotto());
  const Component& scene = scene_of(look);
  const Rooms rooms = find_rooms(look.survey, look.measure, look.tree, scene);
  const auto drawn = [&](std::uint64_t seed) {
    std::vector<ways::NodeId> all;
    for (const Ends& ends : draw_paths(look.tree, scene, rooms, 0, seed)) all.insert(all.end(), {ends.from, ends.to});
    return all;
  };
  EXPECT_EQ(drawn(1), drawn(1));
  EXPECT_NE(drawn(1), drawn(2));
}

TEST(TrainRegions, ANeckAndARoomTooSmallForTheBodyGetASmallerOne) {
  const Look look(hall_with_grotto());
  const double radius = 0.7;
  const Rooms rooms = find_rooms(look.survey, look.measure, look.tree, scene_of(look), radius);
  ASSERT_EQ(rooms.necks.size(), 1u);
  Passage passage;
  passage.found = true;
  passage.radius = 0.25;
  passage.opening = Opening{};
  const auto regions = make_regions(look.measure, look.tree, rooms, 0.15, radius, {&passage, 1});
  ASSERT_EQ(regions.size(), 2u);
  for (const SizeRegion& region : regions) EXPECT_DOUBLE_EQ(region.radius, region_share * 0.25);
  EXPECT_EQ(regions[0].why, "door 0.50 m wide");
  EXPECT_EQ(regions[1].why, "behind door 0.50 m wide");
  EXPECT_LT(regions[0].bounds.lower.y, -0.5);
  EXPECT_GT(regions[0].bounds.upper.y, 0.5);
  EXPECT_LE(regions[0].bounds.lower.z, 0.0);
  EXPECT_GE(regions[0].bounds.upper.z, 1.9);
  EXPECT_LT(regions[0].bounds.upper.x - regions[0].bounds.lower.x, 4.0);
}

TEST(TrainRegions, WhatLetsLessThanTheLeastThroughGetsNoneNorWhatIsBehindIt) {
  const Look look(hall_with_grotto());
  const double radius = 0.7;
  const Rooms rooms = find_rooms(look.survey, look.measure, look.tree, scene_of(look), radius);
  Passage passage;
  passage.found = true;
  passage.radius = 0.14;
  passage.opening = Opening{};
  EXPECT_TRUE(make_regions(look.measure, look.tree, rooms, 0.15, radius, {&passage, 1}).empty());
  EXPECT_EQ(make_regions(look.measure, look.tree, rooms, 0.14, radius, {&passage, 1}).size(), 2u);
}

TEST(TrainRegions, ARoomThatTheBodyFitsIntoGetsNone) {
  const Look look(gallery());
  const Rooms rooms = find_rooms(look.survey, look.measure, look.tree, scene_of(look), 0.4);
  ASSERT_EQ(rooms.necks.size(), 3u);
  std::vector<Passage> openings(3);
  for (std::size_t i = 0; i < 3; ++i) openings[i].found = true;
  openings[0].radius = 0.35;
  openings[1].radius = 0.3;
  openings[2].found = false;
  EXPECT_EQ(make_regions(look.measure, look.tree, rooms, 0.15, 0.4, openings).size(), 2u);
}

}  // namespace
}  // namespace roam::training
