// What training answers where a scene has several parts, where a body stands nowhere, and where no one size is of use.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "roam/train.h"
#include "train_scenes.h"
#include "train_shells.h"
#include "words/training.h"

namespace {

using roam::ConnectedPart;
using roam::Mesh;
using roam::Training;
using roam::Vec3;
using roam::words::answer;

bool says(const Training& t, const std::string& part) { return answer(t).find(part) != std::string::npos; }

const ConnectedPart* part_near(const Training& t, const Vec3& place, double within) {
  for (const ConnectedPart& part : t.parts) {
    const Vec3 to = part.place - place;
    if (std::abs(to.x) < within && std::abs(to.y) < within && std::abs(to.z) < 0.5) return &part;
  }
  return nullptr;
}

TEST(TrainedParts, AreNamedEachWithItsPlaceItsFloorAndWhetherItCounts) {
  Mesh mesh;
  shells::add_room(mesh, {0, 0, 0}, {8, 6, 3});
  shells::add_room(mesh, {20, 0, 0}, {24, 5, 3});
  shells::add_room(mesh, {40, 0, 0}, {50, 5, 3}, true);  // a block: its roof is outside
  const Training t = roam::train(survey_of({mesh}), {.height = 1.8});
  const ConnectedPart* large = part_near(t, {4, 3, 0}, 4.0);
  const ConnectedPart* small = part_near(t, {22, 2.5, 0}, 2.5);
  ASSERT_NE(large, nullptr);
  ASSERT_NE(small, nullptr);
  EXPECT_TRUE(large->trained && small->trained);
  EXPECT_EQ(large, &t.parts.front());
  EXPECT_NEAR(large->area, 48.0, 5.0);
  EXPECT_NEAR(small->area, 20.0, 3.0);
  EXPECT_EQ(large->left_out, roam::LeftOut::none);
  EXPECT_TRUE(says(t, "2 parts without a way between them")) << answer(t);
  const ConnectedPart* roof = part_near(t, {45, 2.5, 3}, 5.0);
  ASSERT_NE(roof, nullptr);
  EXPECT_FALSE(roof->trained);
  EXPECT_NE(roof->left_out, roam::LeftOut::none);
  EXPECT_NEAR(roof->area, 50.0, 5.0);
  EXPECT_TRUE(says(t, "Left out: the 5")) << answer(t);
  EXPECT_TRUE(says(t, roam::words::why(roof->left_out))) << answer(t);
}

TEST(TrainedParts, AreRoomsAndNotTheBottomsOfShafts) {
  Mesh mesh;
  shells::add_room(mesh, {0, 0, 0}, {8, 6, 3});
  shells::add_wall_with_door(mesh, 0, 8, 3, 4, 1.2);
  shells::add_room(mesh, {9, 0, -4}, {9.5, 2.2, 3});  // 1.1 m2, and no way leads there
  const Training t = roam::train(survey_of({mesh}), {.height = 1.8});
  ASSERT_TRUE(t.largest);
  EXPECT_NEAR(*t.largest, 0.6, 1e-3) << answer(t);
  const ConnectedPart* shaft = part_near(t, {9.25, 1.1, -4}, 1.2);
  ASSERT_NE(shaft, nullptr);
  EXPECT_FALSE(shaft->trained);
  EXPECT_EQ(shaft->left_out, roam::LeftOut::much_smaller);
  // Alone it is the scene.
  Mesh alone;
  shells::add_room(alone, {9, 0, -4}, {9.5, 2.2, 3});
  const Training only = roam::train(survey_of({alone}), {.height = 1.8});
  ASSERT_FALSE(only.parts.empty());
  EXPECT_TRUE(only.parts.front().trained);
}

TEST(TrainedParts, AreNotARoofThatIsLargerThanTheRoomsBelow) {
  Mesh mesh;
  for (const double x : {0.0, 3.0, 6.0, 9.0}) shells::add_room(mesh, {x, 0, 0}, {x + 2.8, 4, 3});
  scenes::add_floor(mesh, -2, -1, 13.8, 8, 3.5);  // more than half of it over nothing
  const Training t = roam::train(survey_of({mesh}), {.height = 1.8});
  const ConnectedPart* roof = part_near(t, {5.9, 3.5, 3.5}, 8.0);
  ASSERT_NE(roof, nullptr);
  EXPECT_FALSE(roof->trained) << answer(t);
  EXPECT_EQ(roof->left_out, roam::LeftOut::on_top);
  const ConnectedPart* room = part_near(t, {1.4, 2, 0}, 2.0);
  ASSERT_NE(room, nullptr);
  EXPECT_TRUE(room->trained) << answer(t);
}

TEST(TrainedParts, AreThoseThatAPathLeadsThrough) {
  Mesh mesh;
  shells::add_room(mesh, {0, 0, 0}, {8, 6, 3});
  shells::add_room(mesh, {20, 0, 0}, {24, 5, 3});
  const Training t = roam::train(survey_of({mesh}), {.paths = 1, .height = 1.8});
  const ConnectedPart* large = part_near(t, {4, 3, 0}, 4.0);
  const ConnectedPart* small = part_near(t, {22, 2.5, 0}, 2.5);
  ASSERT_NE(large, nullptr);
  ASSERT_NE(small, nullptr);
  EXPECT_TRUE(large->trained);
  EXPECT_FALSE(small->trained);
  EXPECT_NE(small->left_out, roam::LeftOut::none);
  EXPECT_TRUE(says(t, "2 parts without a way between them; paths were planned in 1 of them")) << answer(t);
  EXPECT_TRUE(says(t, roam::words::why(small->left_out))) << answer(t);
}

TEST(TrainedParts, AreNoneForABodyThatIsTallerThanTheRooms) {
  Mesh mesh;
  shells::add_room(mesh, {0, 0, 0}, {8, 6, 2.2});
  shells::add_room(mesh, {-0.4, -0.4, -0.4}, {8.4, 6.4, 2.6}, true);
  const roam::Survey survey = survey_of({mesh});
  const Training tall = roam::train(survey, {.height = 2.3});
  EXPECT_FALSE(tall.feasible);
  EXPECT_TRUE(tall.paths.empty());
  EXPECT_EQ(tall.nowhere, roam::Nowhere::over_low_rooms) << answer(tall);
  EXPECT_TRUE(says(tall, "2.60)")) << "where it does stand: " << answer(tall);
  const Training fits = roam::train(survey, {.height = 2.1});
  EXPECT_TRUE(fits.feasible) << answer(fits);
  EXPECT_FALSE(says(fits, "nowhere"));
}

/// A hall with four side rooms, one of them behind a slit.
Mesh hall(double slit) {
  using namespace scenes;
  Mesh mesh;
  shells::add_room(mesh, {-6, -4, 0}, {6, 4, 3});
  const auto closet = [&](double x0, double x1, double y, double side, double door) {
    const double middle = 0.5 * (x0 + x1);
    add_box(mesh, {x0, y - 0.05, 0}, {middle - 0.5 * door, y + 0.05, 3});
    add_box(mesh, {middle + 0.5 * door, y - 0.05, 0}, {x1, y + 0.05, 3});
    add_box(mesh, {x0 - 0.1, std::min(y, side), 0}, {x0, std::max(y, side), 3});
    add_box(mesh, {x1, std::min(y, side), 0}, {x1 + 0.1, std::max(y, side), 3});
  };
  closet(-5, -2, 2, 4, 0.9);
  closet(2, 5, 2, 4, 0.9);
  closet(-5, -2, -2, -4, 0.9);
  closet(2, 5, -2, -4, slit);
  return mesh;
}

TEST(TrainedParts, WhereNoUsefulSizeServesAllTheBodyIsTheOneThatServesMost) {
  const Training t = roam::train(survey_of({hall(0.28)}), {.height = 1.8, .spacing = 0.1});
  ASSERT_TRUE(t.largest);
  EXPECT_NEAR(*t.largest, 0.14, 1e-3);
  EXPECT_FALSE(t.feasible);
  EXPECT_DOUBLE_EQ(t.radius, 0.3);
  EXPECT_TRUE(says(t, "No useful size serves all")) << answer(t);
  EXPECT_TRUE(says(t, "0.140 m")) << answer(t);
  EXPECT_TRUE(t.contradictions.empty()) << answer(t);
  const auto served = std::count_if(t.paths.begin(), t.paths.end(),
                                    [](const auto& path) { return !path.largest || *path.largest >= 0.3; });
  EXPECT_GT(served, 0);
  EXPECT_TRUE(says(t, "it serves " + std::to_string(served) + " of them")) << answer(t);
  // A region would make the person one of 27 cm.
  EXPECT_TRUE(t.regions.empty());
  const Training device = roam::train(survey_of({hall(0.28)}), {.radius_min = 0.1, .height = 1.8, .spacing = 0.1});
  EXPECT_TRUE(device.feasible) << answer(device);
  EXPECT_NEAR(device.radius, 0.136, 2e-3);
  const Training wide = roam::train(survey_of({hall(0.9)}), {.height = 1.8});
  EXPECT_TRUE(wide.feasible) << answer(wide);
}

TEST(TrainedParts, OfASphereAreThoseThatItClimbsTo) {
  // A door of 0.3 m, and behind it a platform that only a larger sphere climbs.
  using namespace scenes;
  Mesh mesh;
  shells::add_room(mesh, {0, 0, 0}, {6, 4, 3});
  shells::add_room(mesh, {6, 0, 0.25}, {9, 4, 3});
  for (auto it = mesh.triangles.begin(); it != mesh.triangles.end();) {
    const roam::Triangle t = mesh.triangle(static_cast<std::size_t>(it - mesh.triangles.begin()));
    const bool between = t[0].x == 6.0 && t[1].x == 6.0 && t[2].x == 6.0;
    it = between ? mesh.triangles.erase(it) : it + 1;
  }
  add_wall(mesh, 6, 0, 6, 4, 0.0, 0.25);
  add_box(mesh, {3, 0, 0}, {3.1, 1.85, 3});
  add_box(mesh, {3, 2.15, 0}, {3.1, 4, 3});
  const Training t = roam::train(survey_of({mesh}), {});
  ASSERT_TRUE(t.largest) << answer(t);
  EXPECT_NEAR(*t.largest, 0.15, 1e-3);
  EXPECT_TRUE(t.feasible) << answer(t);
  EXPECT_TRUE(t.contradictions.empty()) << answer(t);
  for (const roam::TrainedPath& path : t.paths) EXPECT_NEAR(path.from.z, path.to.z, 0.01);
  EXPECT_NE(part_near(t, {7.5, 2, 0.25}, 1.5), nullptr) << "the platform is a part of its own";
}

TEST(TrainedParts, ADeadEndThatOnlyNarrowsDecidesNothing) {
  // Two rooms, a door of 0.8 m between them, and out of one of them a wedge.
  using namespace scenes;
  Mesh mesh;
  add_floor(mesh, 0, 0, 20, 6, 0.0);
  add_floor(mesh, 0, 0, 20, 6, 3.0);
  for (const double x : {0.0, 12.0}) add_wall(mesh, x, 0, x, x == 0.0 ? 6 : 2.3, 0.0, 3.0);
  add_wall(mesh, 12, 3.7, 12, 6, 0.0, 3.0);
  add_wall(mesh, 0, 0, 12, 0, 0.0, 3.0);
  add_wall(mesh, 0, 6, 12, 6, 0.0, 3.0);
  add_box(mesh, {5, 0, 0}, {5.2, 2.6, 3});
  add_box(mesh, {5, 3.4, 0}, {5.2, 6, 3});
  add_wall(mesh, 12, 2.3, 17, 3.0, 0.0, 3.0);
  add_wall(mesh, 12, 3.7, 17, 3.0, 0.0, 3.0);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Training t = roam::train(survey_of({mesh}), {.seed = seed, .height = 1.8});
    ASSERT_TRUE(t.largest) << answer(t);
    EXPECT_NEAR(*t.largest, 0.4, 1e-3) << answer(t);
  }
}

TEST(TrainedParts, InAPocketOfARoomNoPathEndsThatDecides) {
  // Behind a pier is a niche that opens to the room by 0.5 m and is no room itself: too small.
  using namespace scenes;
  Mesh mesh;
  shells::add_room(mesh, {0, 0, 0}, {10, 5, 3});
  add_box(mesh, {5, 0, 0}, {5.2, 2.1, 3});
  add_box(mesh, {5, 2.9, 0}, {5.2, 5, 3});
  add_box(mesh, {9.4, 0, 0}, {9.5, 4.2, 3});  // a slot 0.5 m wide along the far wall, open at one end
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Training t = roam::train(survey_of({mesh}), {.seed = seed, .paths = 2, .height = 1.8});
    ASSERT_TRUE(t.largest) << answer(t);
    EXPECT_NEAR(*t.largest, 0.4, 1e-3) << seed << ": " << answer(t);
  }
}

TEST(TrainedParts, HaveNoCracksBehindAThinWall) {
  // Along the wall of a room, aslant to the lattice, runs a ledge of 8 cm on its far side, and beside it a gap of 0.6 m
  // under a ceiling that is too low for anybody.
  using namespace scenes;
  constexpr double length = 6.0, near = 3.0, far = 4.02, ledge = 0.08, gap = 0.6;
  // Its wall may be badly made, of boards with slits between them.
  enum Wall : std::uint8_t { none, whole, of_boards_1_mm, of_boards_1_cm };
  for (const Wall wall : {none, whole, of_boards_1_mm, of_boards_1_cm}) {
    SCOPED_TRACE(static_cast<int>(wall));
    const auto y_at = [](double x) { return near + (far - near) * x / length; };
    const double slit = wall == of_boards_1_mm ? 0.001 : wall == of_boards_1_cm ? 0.01 : 0.0;
    const double board = slit > 0.0 ? 10.0 * slit : length;
    Mesh mesh;
    add_quad(mesh, {0, 0, 0}, {length, 0, 0}, {length, far + ledge, 0}, {0, near + ledge, 0});
    add_quad(mesh, {0, 0, 3}, {length, 0, 3}, {length, far, 3}, {0, near, 3});
    add_quad(mesh, {0, near, 1.2}, {length, far, 1.2}, {length, far + 1, 1.2}, {0, near + 1, 1.2});
    for (double x = 0.0; x < length - 0.5 * board; x += board) {
      const double end = x + board - slit;
      add_wall(mesh, x, y_at(x), end, y_at(end), wall == none ? 1.2 : 0.0, 3.0);
    }
    add_wall(mesh, 0, near + ledge + gap, length, far + ledge + gap, -2.0, 3.0);
    add_wall(mesh, 0, 0, length, 0, 0.0, 3.0);
    for (const double x : {0.0, length}) add_wall(mesh, x, 0, x, far + 1, -2.0, 3.0);
    const Training t = roam::train(survey_of({mesh}), {.height = 1.8});
    EXPECT_EQ(t.cracks.empty(), wall != none) << answer(t);
  }
}

TEST(TrainedParts, HaveOpenDropsBehindAThinWall) {
  // As before, with a floor 2 m deeper and 2.5 m of nothing beside the ledge.
  using namespace scenes;
  constexpr double length = 6.0, near = 3.0, far = 4.02, ledge = 0.08, pit = 2.5;
  Mesh mesh;
  add_quad(mesh, {0, 0, 0}, {length, 0, 0}, {length, far + ledge, 0}, {0, near + ledge, 0});
  add_quad(mesh, {0, 0, 3}, {length, 0, 3}, {length, far, 3}, {0, near, 3});
  add_quad(mesh, {0, near, 1.2}, {length, far, 1.2}, {length, far + pit, 1.2}, {0, near + pit, 1.2});
  add_wall(mesh, 0, near, length, far, 0.0, 3.0);
  add_wall(mesh, 0, near + ledge + pit, length, far + ledge + pit, -2.0, 3.0);
  add_wall(mesh, 0, 0, length, 0, 0.0, 3.0);
  for (const double x : {0.0, length}) add_wall(mesh, x, 0, x, far + pit, -2.0, 3.0);
  const Training t = roam::train(survey_of({mesh}), {.height = 1.8});
  ASSERT_FALSE(t.cracks.empty());
  for (const roam::Crack& crack : t.cracks) EXPECT_EQ(crack.kind, roam::Crack::Kind::open_drop);
}

TEST(TrainedRegions, AreNoneWhereADoorLetsTheBodyThrough) {
  // A door of 0.6 m near a corner, so that the lattice's places before it lie beside its jambs; the other way, under a
  // lintel, is too low.
  using namespace scenes;
  for (const double jamb : {4.0, 3.95, 4.1}) {
    SCOPED_TRACE(jamb);
    Mesh mesh;
    shells::add_room(mesh, {0, 0, 0}, {12, 6, 3});
    add_box(mesh, {6, 0, 0}, {6.2, 1, 3});
    add_box(mesh, {6, 1, 1.7}, {6.2, 2.2, 3});
    add_box(mesh, {6, 2.2, 0}, {6.2, jamb, 3});
    add_box(mesh, {6, jamb + 0.6, 0}, {6.2, 6, 3});
    const Training t = roam::train(survey_of({mesh}), {.height = 1.8});
    ASSERT_TRUE(t.largest);
    EXPECT_NEAR(*t.largest, 0.3, 1e-3);
    EXPECT_TRUE(t.regions.empty()) << t.regions.front().why << " " << t.regions.front().radius;
  }
}

TEST(TrainedDisc, IsSaidToCarryWhereTheLargestJustDoes) {
  using namespace scenes;
  constexpr double gap = 1.994;
  Mesh mesh;
  shells::add_room(mesh, {0, -2, -4}, {10, 2, 3});
  add_floor(mesh, 0, -2, 5 - 0.5 * gap, 2, 0);
  add_floor(mesh, 5 + 0.5 * gap, -2, 10, 2, 0);
  const Training t = roam::train(survey_of({mesh}), {.support_max = 1.0, .height = 1.8});
  EXPECT_NEAR(t.smallest, 0.5 * gap, 1e-3) << answer(t);
  EXPECT_DOUBLE_EQ(t.support_radius, 1.0);
  EXPECT_LE(t.least_support, 1.0) << answer(t);
  EXPECT_TRUE(t.contradictions.empty()) << answer(t);
  bool tried = false;
  for (const roam::TrainedPath& path : t.paths) {
    for (const roam::Trial& trial : path.trials) {
      EXPECT_LE(trial.support_radius, 1.0);
      tried = tried || trial.support_radius == 1.0;
    }
  }
  EXPECT_TRUE(tried);
}

TEST(TrainedDisc, IsSaidToBeForTheCrackOnThePathThatItCarriesOver) {
  const Training t = roam::train(corridor({.door = 0.9, .split = 0.86}), {.height = 1.8});
  EXPECT_GT(t.support_radius, t.radius) << answer(t);
  EXPECT_TRUE(t.feasible) << answer(t);
  EXPECT_TRUE(says(t, "The support disc is for that crack")) << answer(t);
  EXPECT_FALSE(says(t, "beside the paths")) << answer(t);
}

}  // namespace
