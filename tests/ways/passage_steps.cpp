// Where ways lead up and down, and that none leads where a walker cannot step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "roam/passage.h"
#include "walker_scenes.h"
#include "ways/trials/trials.h"

namespace {

using namespace scenes;
using roam::Outcome;
using roam::Passage;
using roam::Survey;
using roam::ways::BodyKind;
using roam::ways::try_way;

constexpr double height = 1.8, person_radius = 0.3;

Survey lossless(const Mesh& mesh) { return Survey::build({mesh}, {.threads = 1, .lossless = true, .progress = {}}); }

Passage widest_at(const Mesh& mesh, const Vec3& from, const Vec3& to, double step = 0.3) {
  return roam::widest_way(lossless(mesh), from, to, {.height = height, .step = step});
}

/// How a person_radius fares along a way, there or back.
Outcome walked(const Mesh& mesh, std::vector<Vec3> way) {
  return try_way(lossless(mesh), BodyKind{.height = height}, person_radius, 0.0, way).outcome;
}

/// Walls from -4 to 3 m round 10 by 4 m: without a floor.
Mesh shaft() {
  Mesh m;
  for (const double y : {-2.0, 2.0}) add_wall(m, 0.0, y, 10.0, y, -4.0, 3.0);
  for (const double x : {0.0, 10.0}) add_wall(m, x, -2.0, x, 2.0, -4.0, 3.0);
  return m;
}

Mesh short_room() {
  Mesh m = shaft();
  add_floor(m, 0.0, -2.0, 10.0, 2.0, 0.0);
  return m;
}
constexpr Vec3 left_end{1.0, 0.0, 0.0}, right_end{9.0, 0.0, 0.0};

TEST(PassageSteps, CrossTheWidestGapThatTheLargestDiscSpansAndNoWider) {
  constexpr double foot = 1.0;
  for (const double gap : {1.994, 2.006}) {
    SCOPED_TRACE(gap);
    Mesh m = shaft();
    add_floor(m, 0.0, -2.0, 5.0 - 0.5 * gap, 2.0, 0.0);
    add_floor(m, 5.0 + 0.5 * gap, -2.0, 10.0, 2.0, 0.0);
    const bool spanned = gap < 2.0 * foot;
    const Survey survey = lossless(m);
    EXPECT_EQ(roam::widest_way(survey, left_end, right_end, {.height = height, .support_max = foot}).found, spanned);
    EXPECT_EQ(try_way(survey, {.height = height}, person_radius, foot, std::vector{left_end, right_end}).outcome,
              spanned ? Outcome::reached : Outcome::fell);
  }
}

TEST(PassageSteps, CrossNoGapThatTheLargestDiscSpansByAHairsBreadth) {
  // To be sure of such gaps every walker that is sent over one would look at all of their rims.
  for (const double foot : {1.0, 0.4}) {
    for (const double share : {0.997, 0.999, 0.9998}) {
      SCOPED_TRACE(share);
      const double gap = share * 2.0 * foot;
      Mesh m = shaft();
      add_floor(m, 0.0, -2.0, 5.0 - 0.5 * gap, 2.0, 0.0);
      add_floor(m, 5.0 + 0.5 * gap, -2.0, 10.0, 2.0, 0.0);
      const roam::PassageOptions options{.height = height, .support_max = foot};
      EXPECT_EQ(roam::widest_way(lossless(m), left_end, right_end, options).found, share < 0.998);
    }
  }
}

TEST(PassageSteps, LeadUpAndDownStairsThatAreSteeperThanTheyAreDeep) {
  constexpr int risers = 8;
  for (const auto& [riser, tread] :
       {std::pair{0.2, 0.15}, {0.17, 0.15}, {0.25, 0.15}, {0.28, 0.18}, {0.3, 0.2}, {0.3, 0.25}}) {
    SCOPED_TRACE(testing::Message() << riser << " " << tread);
    Mesh m;
    constexpr double foot = 4.03;
    add_floor(m, 0.0, -1.5, foot, 1.5, 0.0);
    for (int i = 0; i < risers; ++i)
      add_box(m, {foot + i * tread, -1.5, 0.0}, {foot + (i + 1) * tread, 1.5, riser * (i + 1)});
    add_box(m, {foot + risers * tread, -1.5, 0.0}, {12.0, 1.5, riser * risers});
    for (const double y : {-1.5, 1.5}) add_wall(m, 0.0, y, 12.0, y, 0.0, 6.0);
    for (const double x : {0.0, 12.0}) add_wall(m, x, -1.5, x, 1.5, 0.0, 6.0);
    const Vec3 below(1.0, 0.0, 0.0), above(11.0, 0.0, riser * risers);
    const Survey survey = lossless(m);
    for (const auto& [from, to] : {std::pair{below, above}, {above, below}}) {
      SCOPED_TRACE(from.z);
      const Passage passage = roam::widest_way(survey, from, to, {.height = height});
      ASSERT_TRUE(passage.found);
      EXPECT_EQ(try_way(survey, {.height = height}, person_radius, 0.0, passage.way).outcome, Outcome::reached);
    }
  }
}

TEST(PassageSteps, KeepToTheFloorBesideAnOpenDrop) {
  // A ledge 1 m wide along one wall, over a floor 4 m below.
  Mesh m = shaft();
  add_floor(m, 0.0, -2.0, 10.0, -1.0, 0.0);
  add_floor(m, 0.0, -2.0, 10.0, 2.0, -4.0);
  const Passage p = widest_at(m, {1.0, -1.5, 0.0}, {9.0, -1.5, 0.0});
  ASSERT_TRUE(p.found);
  for (const Vec3& place : p.way) EXPECT_LE(place.y, -0.97);
  EXPECT_EQ(walked(m, p.way), Outcome::reached);
}

TEST(PassageSteps, LeadOverASplitAndOverNoOpenDrop) {
  for (const double gap : {0.4, 1.2, 1.9, 2.2, 3.0}) {
    Mesh m = shaft();
    add_floor(m, 0.0, -2.0, 5.0 - 0.5 * gap, 2.0, 0.0);
    add_floor(m, 5.0 + 0.5 * gap, -2.0, 10.0, 2.0, 0.0);
    EXPECT_EQ(widest_at(m, left_end, right_end).found, gap < 2.0) << gap;
  }
}

/// A room with two benches along the way, from x = 3 to 7.
Mesh benches(double apart, double high) {
  Mesh m = short_room();
  add_box(m, {3.0, -2.0, 0.0}, {7.0, -0.5 * apart, high});
  add_box(m, {3.0, 0.5 * apart, 0.0}, {7.0, 2.0, high});
  return m;
}

TEST(PassageSteps, BetweenBenchesTooHighToStepOnAreAsWideAsAWalkerIsThere) {
  constexpr double aside = 0.4;
  using Case = std::pair<double, double>;  // heights of benches and body
  for (const auto& [high, tall] : {Case(0.32, height), Case(0.36, height), Case(0.5, height), Case(0.36, 0.0)}) {
    SCOPED_TRACE(testing::Message() << high << " " << tall);
    const Survey survey = lossless(benches(2.0 * aside, high));
    const Passage p = roam::widest_way(survey, left_end, right_end, {.height = tall});
    ASSERT_TRUE(p.found && p.limited && p.opening);
    // A round body touches the edge of a low bench with its lower half ball.
    const double touches = high < aside ? (aside * aside + high * high) / (2.0 * high) : aside;
    EXPECT_NEAR(p.radius, touches, 1e-3);
    EXPECT_NEAR(std::abs(p.opening->direction.y), 1.0, 1e-3);
    EXPECT_EQ(try_way(survey, {.height = tall}, 0.98 * touches, 0.0, p.way).outcome, Outcome::reached);
    EXPECT_EQ(try_way(survey, {.height = tall}, 1.02 * touches, 0.0, p.way).outcome, Outcome::blocked);
  }
}

TEST(PassageSteps, BesideABenchThatIsHardlyTooHighToStepOnLeadNoFartherOverIt) {
  // A straight way would lead over its corner, which a body touches somewhere along its height.
  for (const double high : {0.305, 0.31, 0.33}) {
    SCOPED_TRACE(high);
    Mesh m = short_room();
    add_wall(m, 5.0, -2.0, 5.0, -0.33, 0.0, 3.0);
    add_box(m, {4.3, 0.1, 0.0}, {4.95, 2.0, high});
    const Survey survey = lossless(m);
    const Passage p = roam::widest_way(survey, left_end, right_end, {.height = height});
    ASSERT_TRUE(p.found && p.limited);
    const double half = 0.5 * std::hypot(0.43, 0.05);
    EXPECT_NEAR(p.radius, half, 1e-3);
    EXPECT_EQ(try_way(survey, {.height = height}, 0.98 * half, 0.0, p.way).outcome, Outcome::reached);
    EXPECT_EQ(try_way(survey, {.height = height}, 1.02 * half, 0.0, p.way).outcome, Outcome::blocked);
  }
}

TEST(PassageSteps, BetweenWallsThatLeanAreAsWideAsAtTheFeet) {
  constexpr double aside = 0.5, lean = 0.01;
  Mesh m = short_room();
  for (const double side : {-1.0, 1.0}) {
    const double low = side * aside, high = side * (aside + 3.0 * lean);
    add_quad(m, {3.0, low, 0.0}, {7.0, low, 0.0}, {7.0, high, 3.0}, {3.0, high, 3.0});
    for (const double x : {3.0, 7.0})
      add_quad(m, {x, low, 0.0}, {x, side * 2.0, 0.0}, {x, side * 2.0, 3.0}, {x, high, 3.0});
  }
  const Passage p = widest_at(m, left_end, right_end);
  ASSERT_TRUE(p.found && p.limited);
  EXPECT_NEAR(p.radius, aside, 0.02);
  EXPECT_EQ(walked(m, p.way), Outcome::reached);
}

TEST(PassageSteps, BetweenKerbsThatOneStepsOnAreNotNarrow) {
  const Passage p = widest_at(benches(0.8, 0.2), left_end, right_end);
  ASSERT_TRUE(p.found);
  EXPECT_FALSE(p.limited) << p.radius;
}

TEST(PassageSteps, EndWhereTheFloorEnds) {
  Mesh m;
  add_floor(m, 0.0, -2.0, 10.0, 2.0, 0.0);
  const Passage p = widest_at(m, left_end, {10.2, 0.0, 0.0});
  ASSERT_TRUE(p.found);
  EXPECT_LE(p.way.back().x, 10.02);
  EXPECT_EQ(walked(m, p.way), Outcome::reached);
}

TEST(PassageSteps, LeadOntoNoTable) {
  Mesh m = short_room();
  add_box(m, {4.0, -1.0, 0.0}, {6.0, 1.0, 0.75});
  EXPECT_FALSE(widest_at(m, left_end, {5.0, 0.0, 0.75}).found);
  EXPECT_FALSE(widest_at(m, {5.0, 0.0, 0.75}, left_end).found);
  EXPECT_EQ(walked(m, widest_at(m, left_end, right_end).way), Outcome::reached);
}

TEST(PassageSteps, LeadOntoABedByWhatOneStepsOn) {
  for (const bool has_step : {false, true}) {
    Mesh m = short_room();
    add_box(m, {4.0, -1.0, 0.0}, {6.0, 1.0, 0.5});
    if (has_step) add_box(m, {3.4, -1.0, 0.0}, {4.0, 1.0, 0.25});
    const Passage up = widest_at(m, left_end, {5.0, 0.0, 0.5}), down = widest_at(m, {5.0, 0.0, 0.5}, left_end);
    EXPECT_EQ(up.found, has_step);
    EXPECT_EQ(down.found, has_step);
    if (!has_step) continue;
    EXPECT_EQ(walked(m, up.way), Outcome::reached);
    EXPECT_EQ(walked(m, down.way), Outcome::reached);
  }
}

TEST(PassageSteps, RollOverNothingHigherThanAStep) {
  for (const double top : {0.29, 0.31, 0.36, 0.45, 0.6}) {
    for (const double thick : {0.02, 0.15, 0.8}) {
      Mesh m = short_room();
      add_box(m, {5.0, -2.0, 0.0}, {5.0 + thick, 2.0, top});
      EXPECT_EQ(widest_at(m, left_end, right_end).found, top < 0.3) << top << " " << thick;
    }
  }
}

TEST(PassageSteps, LeadUpAndDownStairs) {
  Mesh m;
  const double rise = 0.18, tread = 0.28;
  add_floor(m, 0.0, -1.0, 3.0, 1.0, 0.0);
  for (int i = 0; i < 8; ++i) {
    const double x = 3.0 + tread * i;
    add_wall(m, x, -1.0, x, 1.0, rise * i, rise * (i + 1));
    add_floor(m, x, -1.0, x + tread, 1.0, rise * (i + 1));
  }
  add_floor(m, 3.0 + 8 * tread, -1.0, 9.0, 1.0, 8 * rise);
  for (const double y : {-1.0, 1.0}) add_wall(m, 0.0, y, 9.0, y, 0.0, 4.0);
  const Vec3 top{8.0, 0.0, 8 * rise};
  const Passage up = widest_at(m, left_end, top), down = widest_at(m, top, left_end);
  ASSERT_TRUE(up.found);
  ASSERT_TRUE(down.found);
  EXPECT_FALSE(up.limited);
  EXPECT_EQ(walked(m, up.way), Outcome::reached);
  EXPECT_EQ(walked(m, down.way), Outcome::reached);
}

TEST(PassageSteps, OfABodyThatClimbsNothingLeadOverLevelFloor) {
  Mesh m = short_room();
  EXPECT_TRUE(widest_at(m, left_end, right_end, 0.0).found);
  add_box(m, {5.0, -2.0, 0.0}, {5.5, 2.0, 0.05});
  EXPECT_FALSE(widest_at(m, left_end, right_end, 0.0).found);
  EXPECT_TRUE(widest_at(m, left_end, right_end, 0.06).found);
}

/// Two floors, one higher than a body steps: looked at from both ends.
Mesh ledge() {
  Mesh m = shaft();
  add_floor(m, 0.0, -2.0, 5.0, 2.0, 0.0);
  add_box(m, {5.0, -2.0, -1.0}, {10.0, 2.0, 0.4});
  return m;
}
constexpr Vec3 on_ledge{9.0, 0.0, 0.4};
/// 10 by 4 m, every 0.2 m.
constexpr std::uint64_t places_on_ledge = 1000;

TEST(PassageSteps, CountThePlacesOfTheSearchesFromBothEndsTogether) {
  const Survey survey = lossless(ledge());
  std::uint64_t last = 0;
  bool counts_back = false;
  roam::PassageOptions options{.height = height};
  options.progress = [&](std::uint64_t places) {
    counts_back |= places < last;
    last = places;
    return true;
  };
  const Passage whole = roam::widest_way(survey, left_end, on_ledge, options);
  EXPECT_FALSE(whole.found);
  EXPECT_TRUE(whole.complete);
  EXPECT_TRUE(whole.opening);
  EXPECT_FALSE(counts_back);
  EXPECT_GE(whole.places, last);
  EXPECT_GT(whole.places, places_on_ledge * 3 / 2);
}

TEST(PassageSteps, EndWhenTheyAreToldToInTheSearchFromTheOtherEndToo) {
  const Survey survey = lossless(ledge());
  const auto expect_ended = [&](std::uint64_t most, const roam::PassageOptions& options) {
    const Passage p = roam::widest_way(survey, left_end, on_ledge, options);
    EXPECT_FALSE(p.found);
    EXPECT_FALSE(p.complete);
    EXPECT_LT(p.places, most + places_on_ledge / 2);
  };
  for (const std::uint64_t most : {places_on_ledge / 2, places_on_ledge * 3 / 2}) {
    SCOPED_TRACE(most);
    expect_ended(most, {.height = height, .most_places = most});
    expect_ended(most, {.height = height, .progress = [&](std::uint64_t places) { return places < most; }});
  }
}

TEST(PassageSteps, AreNotLookedForFromTheOtherEndThroughAWall) {
  Mesh m = short_room();
  add_box(m, {5.0, -2.0, 0.0}, {5.2, 2.0, 3.0});
  const Passage p = widest_at(m, left_end, right_end);
  EXPECT_FALSE(p.found);
  ASSERT_TRUE(p.opening);
  EXPECT_LT(p.places, places_on_ledge * 11 / 10);
}

TEST(PassageSteps, KnowSoonThatAnEndIsShutIn) {
  // A closet on a plain of 10,000 m2, of which only as much is looked at as it needs to say where they part.
  Mesh m;
  add_floor(m, -100.0, -100.0, 100.0, 100.0, 0.0);
  add_box(m, {-1.0, -1.0, -0.5}, {1.0, 1.0, 3.0});
  for (const bool from_closet : {true, false}) {
    const Vec3 in{0.0, 0.0, 0.0}, out{5.0, 0.0, 0.0};
    const Passage p = from_closet ? widest_at(m, in, out) : widest_at(m, out, in);
    EXPECT_FALSE(p.found);
    EXPECT_TRUE(p.complete);
    EXPECT_LT(p.places, 200'000);
    ASSERT_TRUE(p.opening);
    EXPECT_NEAR(std::max(std::abs(p.opening->point.x), std::abs(p.opening->point.y)), 1.0, 0.5);
  }
}

}  // namespace
