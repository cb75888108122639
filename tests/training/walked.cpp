// Ways that training plans are ways that a walker goes: where a lattice is wrong, the walker is right.
#include <gtest/gtest.h>

#include "roam/train.h"
#include "train_scenes.h"
#include "train_shells.h"
#include "words/training.h"

namespace {

using namespace scenes;
using roam::Mesh;
using roam::Training;
using roam::Vec3;
using roam::words::answer;

constexpr double seat = 0.4;  ///< m: higher than a step

/// A room with two seats 0.3 m apart. To one of them leads a stair; to the other nothing but the gap between.
Mesh seats() {
  Mesh mesh;
  shells::add_room(mesh, {0, 0, 0}, {8, 6, 3});
  add_box(mesh, {3, 1, 0}, {4.6, 3, seat});
  add_box(mesh, {2.5, 1, 0}, {3, 3, 0.5 * seat});
  add_box(mesh, {4.9, 1, 0}, {6.5, 3, seat});
  return mesh;
}

TEST(TrainedWays, LeadOverNoSeatsThatNobodyClimbs) {
  const Training t = roam::train(survey_of({seats()}), {.radius_max = 0.5, .height = 1.8});
  EXPECT_TRUE(t.feasible) << answer(t);
  EXPECT_TRUE(t.contradictions.empty()) << answer(t);
  EXPECT_DOUBLE_EQ(t.support_radius, 0.0);
  ASSERT_FALSE(t.paths.empty());
  for (const roam::TrainedPath& path : t.paths) {
    for (const Vec3& place : path.way) EXPECT_FALSE(place.x > 4.9 && place.z > 0.5 * seat) << place.x << " " << place.z;
  }
}

/// Two rooms that a groove 3 m long joins, with walls that lean in below the knee.
Mesh groove() {
  Mesh mesh;
  constexpr double bottom = 0.03, top = 0.5, bank = 1.2, high = 3.0;
  add_floor(mesh, 0, -3, 4, 3, 0.0);
  add_floor(mesh, 7, -3, 11, 3, 0.0);
  add_floor(mesh, 4, -bottom, 7, bottom, 0.0);
  add_floor(mesh, 0, -3, 11, 3, high);
  for (const double x : {0.0, 11.0}) add_wall(mesh, x, -3, x, 3, 0, high);
  for (const double side : {-1.0, 1.0}) {
    add_quad(mesh, {4, side * bottom, 0}, {7, side * bottom, 0}, {7, side * top, bank}, {4, side * top, bank});
    add_wall(mesh, 4, side * top, 7, side * top, bank, high);
    add_wall(mesh, 0, 3 * side, 11, 3 * side, 0, high);
    for (const double x : {4.0, 7.0}) {
      add_triangle(mesh, {x, side * bottom, 0}, {x, side * top, 0}, {x, side * top, bank});
      add_wall(mesh, x, 3 * side, x, side * top, 0, high);
    }
  }
  return mesh;
}

TEST(TrainedWays, ThatNoWalkerGoesAreTold) {
  const Training t = roam::train(survey_of({groove()}), {.height = 1.8});
  EXPECT_TRUE(t.contradictions.empty()) << answer(t);
  ASSERT_FALSE(t.unwalked.empty()) << answer(t);
  EXPECT_EQ(t.unwalked.front().outcome, roam::Outcome::blocked);
  for (const roam::UnwalkedPath& path : t.unwalked) {
    EXPECT_LT(path.at.z, 0.3) << "of the feet, as the ends are";
    EXPECT_GT(path.at.z, -0.01);
  }
}

}  // namespace
