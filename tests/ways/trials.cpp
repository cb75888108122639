// The trials that prove the lower end: who is to fall is sent to where nothing carries him.
#include "ways/trials/trials.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "roam/train.h"
#include "train_scenes.h"
#include "train_shells.h"
#include "training/interval.h"
#include "training/over_gap.h"
#include "words/training.h"

namespace {

using namespace scenes;
using roam::Mesh;
using roam::Training;
using roam::words::answer;

constexpr double length = 11.0, width = 2.0, deep = -2.0, high = 3.0;

/// Two ends of a corridor, from x = 0 to 5 and from 5 + `hole` on, with walls around.
Mesh two_ends(double hole) {
  Mesh mesh;
  add_floor(mesh, 0, 0, 5, width, 0);
  add_floor(mesh, 5 + hole, 0, length, width, 0);
  add_floor(mesh, 5, 0, 5 + hole, width, deep);
  add_floor(mesh, 0, 0, length, width, high);
  for (const double y : {0.0, width}) add_wall(mesh, 0, y, length, y, deep, high);
  for (const double x : {0.0, length}) add_wall(mesh, x, 0, x, width, deep, high);
  return mesh;
}

/// Who fell of those that were sent over the crack.
std::ptrdiff_t fallen(const Training& t) {
  std::ptrdiff_t count = 0;
  for (const roam::TrainedPath& path : t.paths) {
    count += std::count_if(path.trials.begin(), path.trials.end(),
                           [](const roam::Trial& trial) { return trial.outcome == roam::Outcome::fell; });
  }
  return count;
}

TEST(TrialsOverACrack, GoOverItsMiddleWhereThePathPassesNearItsRim) {
  // A sump at one wall: the middle of the corridor is over it, but so near its rim that this carries who goes there.
  for (const auto& [hole, rim] : {std::pair{0.5, 0.89}, {0.4, 0.91}, {0.4, 0.92}, {1.0, 0.91}}) {
    SCOPED_TRACE(testing::Message() << hole << " " << rim);
    Mesh mesh = two_ends(hole);
    add_floor(mesh, 5, 0, 5 + hole, rim, 0);
    const Training t = roam::train(survey_of({mesh}), {.height = 1.8});
    EXPECT_NEAR(t.smallest, 0.5 * hole, 1e-3);
    EXPECT_TRUE(t.contradictions.empty()) << answer(t);
    EXPECT_GE(fallen(t), 1);
  }
}

TEST(TrialsOverACrack, GoWhereItIsWidestWhereThePathCrossesItElsewhere) {
  // A split of 0.4 m along one wall, of 0.8 m elsewhere, and beyond it a door where it is narrow.
  Mesh mesh = two_ends(1.0);
  add_floor(mesh, 5.4, 0, 6, 0.7, 0);
  add_floor(mesh, 5.8, 0.7, 6, 1.0, 0);
  add_floor(mesh, 5.85, 1.0, 6, 1.6, 0);
  add_floor(mesh, 5.8, 1.6, 6, width, 0);
  add_wall(mesh, 8, 0.9, 8, width, 0, high);
  const Training t = roam::train(survey_of({mesh}), {.height = 1.8});
  EXPECT_GT(t.smallest, 0.4);
  EXPECT_TRUE(t.contradictions.empty()) << answer(t);
  EXPECT_GE(fallen(t), 1);
}

TEST(TrialsOverACrack, ComeFromItsLowerSide) {
  // A gap of 0.4 m right behind a door with a sill of 0.28 m: who comes over the sill drops onto the
  // far rim before he has sunk.
  Mesh mesh;
  shells::add_room(mesh, {0, 0, deep}, {12, 4, high});
  add_floor(mesh, 0, 0, 6.2, 4, 0);
  add_floor(mesh, 6.6, 0, 12, 4, 0);
  add_box(mesh, {6, 0, 0}, {6.2, 1.65, high});
  add_box(mesh, {6, 2.35, 0}, {6.2, 4, high});
  add_box(mesh, {6, 1.65, 0}, {6.2, 2.35, 0.28});
  const Training t = roam::train(survey_of({mesh}), {.height = 1.8});
  ASSERT_TRUE(t.largest);
  EXPECT_NEAR(*t.largest, 0.35, 1e-3);
  EXPECT_NEAR(t.smallest, 0.2, 1e-3);
  EXPECT_TRUE(t.contradictions.empty()) << answer(t);
  EXPECT_GE(fallen(t), 1);
}

/// The same two ends, the first `rise` higher.
Mesh uneven_ends(double hole, double rise) {
  Mesh mesh = two_ends(hole);
  for (int i = 0; i < 4; ++i) mesh.vertices[static_cast<std::size_t>(i)].z += rise;
  add_wall(mesh, 5, 0, 5, width, deep, rise);
  return mesh;
}

/// How a body of the radius ends that comes down over the gap and goes up again.
std::pair<roam::Outcome, roam::Outcome> down_and_up(const roam::Survey& survey, double hole, double rise, double radius,
                                                    double foot) {
  const Vec3 high_end(1.5, 1, rise), low_end(8 + 0.5 * hole, 1, 0);
  const auto goes = [&](const Vec3& from, const Vec3& to) {
    const std::vector<Vec3> way{from, to};
    return roam::ways::try_way(survey, {.height = 1.8}, radius, foot, way).outcome;
  };
  return {goes(high_end, low_end), goes(low_end, high_end)};
}

TEST(UnevenCracks, CarryFromTheRadiusThatTheirRimsAskFor) {
  using roam::Outcome;
  for (const double hole : {0.4, 0.8, 1.2}) {
    for (const double rise : {0.0, 0.03, 0.1, 0.2}) {
      const roam::Survey survey = survey_of({uneven_ends(hole, rise)});
      const double radius = roam::training::carried_from(0.5 * hole, rise, 45.0);
      const auto [down, up] = down_and_up(survey, hole, rise, radius, 0.0);
      EXPECT_EQ(down, Outcome::reached) << hole << " " << rise;
      EXPECT_EQ(up, Outcome::reached) << hole << " " << rise;
      // Higher up the step decides, and a long stride may make one from where a short one has sunk too far.
      if (rise < 0.15 * hole) {
        EXPECT_NE(down_and_up(survey, hole, rise, 0.94 * radius, 0.0).second, Outcome::reached) << hole << " " << rise;
      }
    }
  }
  EXPECT_EQ(roam::training::carried_from(0.4, 0.004, 45.0), 1.08 * 0.4);
}

TEST(UnevenCracks, AreGoneOverInBothDirectionsByTheTrainedBody) {
  int led_down = 0;
  for (const double rise : {0.0, 0.03, 0.1, 0.15, 0.25}) {
    const roam::Survey survey = survey_of({uneven_ends(0.8, rise)});
    const Training t = roam::train(survey, {.height = 1.8});
    EXPECT_TRUE(t.feasible) << answer(t);
    EXPECT_NEAR(t.smallest, 0.4, 1e-3);
    EXPECT_EQ(t.support_radius, 0.0);
    EXPECT_TRUE(t.contradictions.empty()) << rise << ": " << answer(t);
    EXPECT_TRUE(t.unwalked.empty()) << answer(t);
    EXPECT_EQ(t.hardest.has_value(), rise > 0.0) << answer(t);
    if (rise == 0.0) {
      EXPECT_NEAR(t.radius, 0.432, 1e-3);
    }
    // Who came down over the crack, from where there is room to stand to where there is, went back up over it.
    const double room = t.radius + 0.12;
    for (const roam::TrainedPath& path : t.paths) {
      const bool down = path.from.x < 5.0 - room && path.to.x > 5.8 + room && rise > 0.0;
      const auto chosen = std::count_if(path.trials.begin(), path.trials.end(),
                                        [&](const roam::Trial& trial) { return trial.radius == t.radius; });
      EXPECT_EQ(chosen, down ? 2 : 1) << rise << " from " << path.from.x << " to " << path.to.x;
      led_down += down ? 1 : 0;
    }
    const auto [down, up] = down_and_up(survey, 0.8, rise, t.radius, 0.0);
    EXPECT_EQ(down, roam::Outcome::reached) << rise;
    EXPECT_EQ(up, roam::Outcome::reached) << rise << ": " << answer(t);
  }
  EXPECT_GT(led_down, 0);
}

TEST(UnevenCracks, AreNotToBeClimbedBySpheresThatAreSmallerThanTheRimIsHigh) {
  const Training t = roam::train(survey_of({uneven_ends(0.4, 0.25)}), {});
  EXPECT_TRUE(t.feasible) << answer(t);
  EXPECT_NEAR(t.smallest, 0.2, 1e-3);
  EXPECT_TRUE(t.contradictions.empty()) << answer(t);
}

TEST(UnevenCracks, AreNoneWhereKerbsOfOneHeightStandOnBothRims) {
  Mesh mesh = two_ends(0.6);
  add_box(mesh, {4.9, 0, 0}, {5, width, 0.2});
  add_box(mesh, {5.6, 0, 0}, {5.7, width, 0.2});
  const Training t = roam::train(survey_of({mesh}), {.height = 1.8});
  EXPECT_NEAR(t.smallest, 0.3, 1e-3);
  EXPECT_NEAR(t.radius, 1.08 * 0.3, 1e-3) << answer(t);
  EXPECT_TRUE(t.contradictions.empty()) << answer(t);
}

TEST(UnevenCracks, AreNotTriedFromTheirRimWhereAPathEndsOnThat) {
  // By this seed path 3 ends on the lower rim. Who begins there has no floor under him that a foot could go on in.
  constexpr double rise = 0.03;
  Mesh mesh;
  shells::add_room(mesh, {0, 0, deep}, {12, width, 3.5});
  add_floor(mesh, 0, 0, 6, width, rise);
  add_floor(mesh, 6.8, 0, 12, width, 0);
  add_wall(mesh, 6, 0, 6, width, deep, rise);
  const Training t = roam::train(survey_of({mesh}), {.height = 1.8});
  EXPECT_TRUE(std::any_of(t.paths.begin(), t.paths.end(), [](const roam::TrainedPath& path) {
    return std::abs(path.to.x - 6.8) < 1e-6 && std::abs(path.from.z - rise) < 1e-3;
  }));
  EXPECT_TRUE(t.contradictions.empty()) << answer(t);
}

TEST(UnevenCracks, AskForMoreWhereTheirRimsPartElsewhereThanWhereTheyAreWidest) {
  // The near side rises along the crack, which is a little wider where it is level.
  constexpr double rise = 0.3, gap = 0.8;
  Mesh mesh;
  add_quad(mesh, {0, 0, 0}, {4.98, 0, 0}, {5, width, rise}, {0, width, rise});
  add_floor(mesh, 5 + gap, 0, length, width, 0);
  add_floor(mesh, 0, 0, length, width, deep);
  add_floor(mesh, 0, 0, length, width, high);
  for (const double y : {0.0, width}) add_wall(mesh, 0, y, length, y, deep, high);
  for (const double x : {0.0, length}) add_wall(mesh, x, 0, x, width, deep, high);
  const roam::Survey survey = survey_of({mesh});
  const Training t = roam::train(survey, {.height = 1.8});
  EXPECT_TRUE(t.feasible) << answer(t);
  EXPECT_GT(t.radius, 0.45);
  EXPECT_TRUE(t.contradictions.empty()) << answer(t);
  EXPECT_TRUE(t.unwalked.empty()) << answer(t);
  const auto [down, up] = down_and_up(survey, gap, 0.5 * rise, t.radius, t.support_radius);
  EXPECT_EQ(down, roam::Outcome::reached);
  EXPECT_EQ(up, roam::Outcome::reached) << answer(t);
}

TEST(UnevenCracks, AskForADiscWhereWhatRollsUpOverThemIsTooWide) {
  constexpr double rise = 0.2;
  Mesh mesh = uneven_ends(0.8, rise);
  add_wall(mesh, 9, 0, 9, 0.55, 0, high);
  add_wall(mesh, 9, 1.45, 9, width, 0, high);
  const roam::Survey survey = survey_of({mesh});
  const Training t = roam::train(survey, {.height = 1.8});
  ASSERT_TRUE(t.largest);
  EXPECT_NEAR(*t.largest, 0.45, 2e-3);
  EXPECT_FALSE(t.feasible) << answer(t);
  EXPECT_EQ(t.radius, 0.3);
  EXPECT_NEAR(t.support_radius, 0.42, 2e-3);
  EXPECT_TRUE(t.contradictions.empty()) << answer(t);
  EXPECT_TRUE(t.hardest) << answer(t);
  EXPECT_EQ(down_and_up(survey, 0.8, rise, t.radius, t.support_radius).second, roam::Outcome::reached);
}

TEST(UnevenCracks, AndDoorsTellNoIntervalThatIsUpsideDown) {
  constexpr double rise = 0.2;
  const double least = roam::training::carried_from(0.4, rise, 45.0) / 1.0149;  // without its margin
  for (const double door : {0.91, 0.94, 0.955, 0.97, 0.99}) {
    Mesh mesh = uneven_ends(0.8, rise);
    add_wall(mesh, 9, 0, 9, 1.0 - 0.5 * door, 0, high);
    add_wall(mesh, 9, 1.0 + 0.5 * door, 9, width, 0, high);
    const Training t = roam::train(survey_of({mesh}), {.height = 1.7});
    SCOPED_TRACE(answer(t));
    EXPECT_EQ(t.feasible, least < 0.5 * door) << door;
    if (t.feasible) {
      EXPECT_GE(t.radius, least - 1e-3);
      EXPECT_LE(t.radius, 0.5 * door);
    } else {
      EXPECT_GT(t.support_radius, 0.4);
    }
    EXPECT_TRUE(t.contradictions.empty()) << roam::words::contradiction(t.contradictions.front());
  }
}

TEST(TrialsOverACrack, AreNotMadeWhereItsWidestPlaceOpensIntoADrop) {
  // A split of 0.62 m that widens to 0.8 m towards the end of both floors: who stands over its mouth has a drop before
  // him, in which a foot finds room.
  constexpr double end = 12.0;
  Mesh mesh;
  add_quad(mesh, {0, 0, 0}, {3.69, 0, 0}, {3.6, end, 0}, {0, end, 0});
  add_quad(mesh, {4.31, 0, 0}, {8, 0, 0}, {8, end, 0}, {4.4, end, 0});
  add_floor(mesh, 0, 0, 8, end + 3, high);
  for (const double y : {0.0, end + 3}) add_wall(mesh, 0, y, 8, y, -3, high);
  for (const double x : {0.0, 8.0}) add_wall(mesh, x, 0, x, end + 3, -3, high);
  const Training t = roam::train(survey_of({mesh}), {.height = 1.8});
  EXPECT_NEAR(t.smallest, 0.4, 2e-3);
  EXPECT_TRUE(t.contradictions.empty()) << answer(t);
}

}  // namespace
