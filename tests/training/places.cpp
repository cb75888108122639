// Where bodies can be: components of the floor, and which of them are meant to be walked in.

#include "training/places/places.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "train_shells.h"
#include "training/places/inside.h"
#include "training/places/samples.h"

namespace roam::training {
namespace {

using shells::Look;

std::size_t inside_of(const Look& look) {
  return static_cast<std::size_t>(
      std::count_if(look.components.begin(), look.components.end(), [](const Component& c) { return c.inside; }));
}

Mesh two_rooms() {
  Mesh mesh;
  shells::add_room(mesh, {0, 0, 0}, {8, 6, 3});
  shells::add_room(mesh, {20, 0, 0}, {24, 5, 3});
  return mesh;
}

/// Walls of half a metre; the roof has more places than the room.
Mesh house() {
  Mesh mesh;
  shells::add_room(mesh, {0, 0, 0}, {8, 6, 3});
  shells::add_room(mesh, {-0.5, -0.5, -0.5}, {8.5, 6.5, 3.5}, true);
  return mesh;
}

TEST(TrainPlaces, DisjointRoomsAreComponentsOfTheirOwnAndBothInside) {
  const Look look(two_rooms());
  const Component* large = look.at({4, 3, 0});
  const Component* small = look.at({22, 2, 0});
  ASSERT_NE(large, nullptr);
  ASSERT_NE(small, nullptr);
  EXPECT_NE(large, small);
  EXPECT_EQ(large, &look.components.front());
  EXPECT_TRUE(large->inside);
  EXPECT_TRUE(small->inside);
  EXPECT_EQ(inside_of(look), 2u);
  EXPECT_NEAR(static_cast<double>(large->nodes.size()), 7.8 * 5.8 / 0.04, 120.0);
  EXPECT_TRUE(large->whole);
}

TEST(TrainPlaces, TheTopOfATunnelIsNotInside) {
  const Look look(two_rooms());
  EXPECT_EQ(look.at({4, 3, 3}), nullptr) << "what only sees backs need not be looked at";
}

TEST(TrainPlaces, TheRoofOfAHouseIsOutside) {
  const Look look(house());
  const Component* room = look.at({4, 3, 0});
  const Component* roof = look.at({4, 3, 3.5});
  ASSERT_NE(room, nullptr);
  ASSERT_NE(roof, nullptr);
  EXPECT_GT(roof->nodes.size(), room->nodes.size());
  EXPECT_TRUE(room->inside);
  EXPECT_EQ(roof->verdict, Verdict::on_top);
}

TEST(TrainPlaces, AHouseWoundTheWrongWayRoundIsTheSame) {
  Mesh mesh = house();
  shells::flip(mesh);
  const Look look(mesh);
  const Component* room = look.at({4, 3, 0});
  ASSERT_NE(room, nullptr);
  EXPECT_EQ(room->back_share, 1.0);
  EXPECT_TRUE(room->inside);
  EXPECT_EQ(inside_of(look), 1u);
}

TEST(TrainPlaces, TunnelsWoundTheWrongWayRoundAreTheSame) {
  Mesh mesh = two_rooms();
  shells::flip(mesh);
  const Look look(mesh);
  ASSERT_NE(look.at({4, 3, 0}), nullptr);
  EXPECT_TRUE(look.at({4, 3, 0})->inside);
  EXPECT_TRUE(look.at({22, 2, 0})->inside);
  EXPECT_EQ(inside_of(look), 2u);
}

TEST(TrainPlaces, WindingsAreTrustedWhereSharedEdgesRunBothWays) {
  const auto share = [](const Mesh& mesh) { return winding_share(Survey::build({mesh})); };
  Mesh mesh = two_rooms();
  EXPECT_EQ(share(mesh), 1.0);
  const std::vector<std::array<std::uint32_t, 3>> once = mesh.triangles;
  mesh.triangles.insert(mesh.triangles.end(), once.begin(), once.end());
  EXPECT_EQ(share(mesh), 1.0) << "twice the same way round is as once";
  mesh.triangles = once;
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  EXPECT_LT(share(mesh), 1.0);
  mesh.triangles = once;
  shells::add_backs(mesh);
  EXPECT_EQ(share(mesh), 0.0);
  Mesh loose;
  scenes::add_triangle(loose, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(share(loose), 0.0) << "no edge is shared";
}

TEST(TrainPlaces, WhereFacesAreThereFromBothSidesWhatIsClosedIsInside) {
  Mesh mesh = two_rooms();
  shells::add_backs(mesh);
  const Look look(mesh);
  EXPECT_EQ(inside_of(look), 2u);
  EXPECT_TRUE(look.at({4, 3, 0})->inside);
  EXPECT_TRUE(look.at({22, 2, 0})->inside);
}

TEST(TrainPlaces, TheTopOfAWallIsALedge) {
  Mesh mesh;
  scenes::add_floor(mesh, 0, 0, 12, 12, 0.0);
  scenes::add_box(mesh, {5, 3, 0}, {5.6, 9, 2.5});
  const Look look(mesh);
  const Component* top = look.at({5.3, 6, 2.5});
  ASSERT_NE(top, nullptr);
  EXPECT_EQ(top->verdict, Verdict::on_top);
  EXPECT_TRUE(look.at({1, 1, 0})->inside);
}

TEST(TrainPlaces, OpenGroundIsTheSceneWhereNothingIsInside) {
  Mesh mesh;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j) {
      const auto z = [](int x, int y) { return 0.3 * ((x * 7 + y * 3) % 4); };
      const auto at = [&](int x, int y) { return Vec3(2.0 * x, 2.0 * y, z(x, y)); };
      scenes::add_quad(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
  for (const bool flipped : {false, true}) {
    if (flipped) shells::flip(mesh);
    const Look look(mesh, 0.4);
    ASSERT_FALSE(look.components.empty());
    EXPECT_TRUE(look.components.front().inside) << flipped;
    EXPECT_EQ(look.components.front().open_share, 1.0);
    EXPECT_GT(look.components.front().nodes.size(), 2000u);
  }
}

TEST(TrainPlaces, OneTriangleIsAScene) {
  Mesh mesh;
  scenes::add_triangle(mesh, {0, 0, 0}, {3, 0, 0}, {0, 3, 0});
  const Look look(mesh);
  ASSERT_EQ(look.components.size(), 1u);
  EXPECT_TRUE(look.components.front().inside);
}

TEST(TrainPlaces, WithoutFloorThereIsNoPlace) {
  Mesh wall;
  scenes::add_wall(wall, 0, 0, 5, 1, 0.0, 3.0);
  EXPECT_TRUE(Look(wall).components.empty());
  EXPECT_TRUE(Look(Mesh{}).components.empty());
}

TEST(TrainPlaces, ALowRoomHasNoPlaceForAPerson) {
  Mesh mesh;
  shells::add_room(mesh, {0, 0, 0}, {8, 6, 1.8});
  EXPECT_EQ(Look(mesh).at({4, 3, 0}), nullptr);
}

TEST(TrainPlaces, WhatIsTooLargeIsCutAndSaysSo) {
  const Look look(two_rooms(), 0.2, 300);
  const Component* cut = look.at({4, 3, 0});
  if (cut == nullptr) cut = look.at({22, 2, 0});
  ASSERT_NE(cut, nullptr);
  EXPECT_TRUE(std::any_of(look.components.begin(), look.components.end(), [](const auto& c) { return !c.whole; }));
  EXPECT_LT(look.tree.size(), 2000u);
}

/// Each place that a tree reached is in one component, and hangs together with its root.
void expect_no_place_is_lost(const ways::WidestTree& tree, const std::vector<Component>& components) {
  std::vector<int> times(tree.size(), 0);
  for (const Component& c : components) {
    for (std::size_t i = 0; i < c.nodes.size(); ++i) {
      ++times[c.nodes[i]];
      if (i % 997 == 0) {
        EXPECT_FALSE(tree.way(c.root, c.nodes[i]).empty());
      }
    }
  }
  std::size_t lost = 0, twice = 0;
  for (ways::NodeId id = 0; id < tree.size(); ++id) {
    if (tree.root(id) != ways::no_node && times[id] == 0) ++lost;
    if (times[id] > 1) ++twice;
  }
  EXPECT_EQ(lost, 0u);
  EXPECT_EQ(twice, 0u);
}

TEST(TrainPlaces, OfPartsThatWereCutNoneIsLost) {
  // Each larger than what is looked at first, and all together than what there may be.
  Mesh mesh;
  for (const double x : {0.0, 60.0, 120.0}) shells::add_room(mesh, {x, 0, 0}, {x + 50, 50, 3});
  const Look look(mesh, 0.2, 70'000);
  for (const double x : {20.0, 80.0, 140.0}) {
    const Component* room = look.at({x, 20, 0});
    ASSERT_NE(room, nullptr) << x;
    EXPECT_GE(room->nodes.size(), 5'000u) << x;
  }
  expect_no_place_is_lost(look.tree, look.components);
}

TEST(TrainPlaces, OfALongObliqueSliverAreSampledAlongItAlone) {
  constexpr double slope = 0.6180339887, width = 0.01, length = 1e6, square = 0.5 * 0.5;
  Mesh mesh;  // its box has 2.5e12 squares
  scenes::add_triangle(mesh, {0, 0, 0}, {width, 0, 0}, {length, slope * length, 0});
  const std::vector<Vec3> samples = sample_places(Survey::build({mesh}), Mode::walk, 1);
  const double expected = 0.5 * width * slope * length / square;
  EXPECT_NEAR(static_cast<double>(samples.size()), expected, 0.05 * expected);
  for (const Vec3& p : samples) {
    const double along = p.x - p.y / slope;
    ASSERT_TRUE(p.y >= 0.0 && along >= -1e-6 && along <= width + 1e-6) << p.x << " " << p.y;
  }
}

TEST(TrainPlaces, AreTheSameForAnyNumberOfThreads) {
  Mesh mesh = two_rooms();
  scenes::add_box(mesh, {2, 2, 0}, {3, 3, 2.5});
  const auto found = [&](int threads, std::uint64_t most) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    const Look look(mesh, 0.2, most);
    std::vector<std::vector<ways::NodeId>> nodes;
    for (const Component& c : look.components) nodes.push_back(c.nodes);
    return nodes;
  };
  for (const std::uint64_t most : {300u, 500'000u}) EXPECT_EQ(found(1, most), found(4, most));
}

TEST(TrainPlaces, TheTopOfALargeRoomIsNotLookedAt) {
  // It is more than what is looked at first, and all of it counts.
  Mesh mesh;
  shells::add_room(mesh, {0, 0, 0}, {40, 40, 3});
  const Look look(mesh);
  ASSERT_NE(look.at({20, 20, 0}), nullptr);
  EXPECT_EQ(look.at({20, 20, 3}), nullptr);
}

TEST(TrainPlaces, WhoIsTooTallForTheRoomsStandsNowhereInside) {
  Mesh shell;
  shells::add_room(shell, {0, 0, 0}, {8, 6, 1.7});
  Mesh thick = shell;
  shells::add_room(thick, {-0.5, -0.5, -0.5}, {8.5, 6.5, 2.2}, true);
  Mesh doubled = shell;
  shells::add_backs(doubled);
  Mesh reversed = thick;
  shells::flip(reversed);
  for (const Mesh& mesh : {shell, thick, doubled, reversed}) {
    const Look look(mesh);
    EXPECT_EQ(inside_of(look), 0u);
    ASSERT_FALSE(look.components.empty());
    EXPECT_EQ(look.components.front().verdict, Verdict::over_low_rooms);
  }
}

TEST(TrainPlaces, TheTopOfSolidGroundIsAScene) {
  Mesh mesh;
  shells::add_room(mesh, {0, 0, 0}, {20, 20, 1.5}, true);
  const Look look(mesh);
  ASSERT_NE(look.at({10, 10, 1.5}), nullptr);
  EXPECT_TRUE(look.at({10, 10, 1.5})->inside);
}

TEST(TrainPlaces, EndedEarlyItAnswersWhatWasFound) {
  const Survey survey = Survey::build({two_rooms()});
  const ways::Measure measure = shells::person();
  ways::WidestTree tree(survey, measure, 0.2);
  int asked = 0;
  const auto found = find_components(survey, measure, tree, 1, [&](double) { return ++asked < 4; });
  EXPECT_LT(tree.size(), 2000u);
  for (const Component& c : found) EXPECT_FALSE(c.nodes.empty());
  expect_no_place_is_lost(tree, found);
}

TEST(TrainPlaces, AreNotToldToBeFoundBeforeTheyAre) {
  // More than is looked at first.
  Mesh mesh;
  shells::add_room(mesh, {0, 0, 0}, {50, 50, 3});
  const Survey survey = Survey::build({mesh});
  ways::WidestTree tree(survey, shells::person(), 0.2);
  double told = 0.0;
  std::size_t places_early = 0;
  (void)find_components(survey, shells::person(), tree, 1, [&](double done) {
    EXPECT_GE(done, told);
    told = done;
    if (done < 0.9) places_early = tree.size();
    return true;
  });
  EXPECT_GT(places_early, tree.size() / 10 * 9);
}

TEST(TrainPlaces, TheOrderOfTrianglesAndAPlaceFarAwayChangeNothing) {
  const Look plain(two_rooms());
  Mesh mesh = two_rooms();
  std::reverse(mesh.triangles.begin(), mesh.triangles.end());
  const Look reversed(mesh);
  scenes::shift(mesh, {-13739, 253, 182});
  const Look moved(mesh);
  for (const Look* other : {&reversed, &moved}) {
    ASSERT_EQ(other->components.size(), plain.components.size());
    for (std::size_t i = 0; i < plain.components.size(); ++i) {
      const double places = static_cast<double>(plain.components[i].nodes.size());
      EXPECT_NEAR(static_cast<double>(other->components[i].nodes.size()), places, 0.1 * places);
      EXPECT_EQ(other->components[i].verdict, plain.components[i].verdict);
    }
  }
}

TEST(TrainPlaces, FlyingTheClosedIsInsideAndTheAirAroundIsNot) {
  const Survey survey = Survey::build({house()}, {.threads = 1, .lossless = true, .progress = {}});
  ways::Measure measure;
  measure.mode = Mode::fly;
  measure.narrowest = 0.2;
  Box within = survey.world().bounds();
  within.lower -= Vec3(2.0);
  within.upper += Vec3(2.0);
  ways::WidestTree tree(survey, measure, 0.4, within);
  const auto found = find_components(survey, measure, tree, 1);
  ASSERT_FALSE(found.empty());
  for (const Component& c : found) {
    const Vec3 place = tree.node(c.root).place;
    const bool in_room = place.x > 0 && place.x < 8 && place.y > 0 && place.y < 6 && place.z > 0 && place.z < 3;
    EXPECT_EQ(c.inside, in_room) << place.x << " " << place.y << " " << place.z;
  }
}

}  // namespace
}  // namespace roam::training
