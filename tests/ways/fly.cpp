// How wide the way between two places in the air is.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "flight_scenes.h"
#include "roam/passage.h"
#include "roam/route.h"
#include "seeded_gallery.h"

namespace {

using namespace scenes;
using roam::Mode;
using roam::Opening;
using roam::Passage;
using roam::PassageOptions;
using roam::Survey;

constexpr double wanted_error = 2e-4;  // m
const PassageOptions flying{.mode = Mode::fly};

Survey survey_to_fly(const Mesh& mesh) {
  return Survey::build({mesh}, {.threads = 1, .lossless = true, .progress = {}});
}

/// Two rooms of 4 m by 3 m by 2.6 m and a wall of 0.2 m between them, from x = -0.1 to 0.1, with an opening.
Mesh rooms(double y0, double y1, double z0, double z1, bool roof = true) {
  Mesh m;
  const double far = 4.0, side = 1.5, top = 2.6;
  add_floor(m, -far, -side, far, side, 0.0);
  if (roof) add_floor(m, -far, -side, far, side, top);
  for (const double y : {-side, side}) add_wall(m, -far, y, far, y, 0.0, top);
  for (const double x : {-far, far}) add_wall(m, x, -side, x, side, 0.0, top);
  add_box(m, {-0.1, -side, 0.0}, {0.1, y0, top});
  add_box(m, {-0.1, y1, 0.0}, {0.1, side, top});
  if (z0 > 0.0) add_box(m, {-0.1, y0, 0.0}, {0.1, y1, z0});
  if (z1 < top) add_box(m, {-0.1, y0, z1}, {0.1, y1, top});
  return m;
}
constexpr Vec3 one_end{-2.5, 0.1, 1.3}, other_end{2.5, 0.0, 1.2};

TEST(Flight, IsHalfTheDoor) {
  for (const double width : {0.5, 0.9}) {
    const Passage p = roam::widest_way(survey_to_fly(rooms(0.2 - 0.5 * width, 0.2 + 0.5 * width, 0.0, 2.0)), one_end,
                                       other_end, flying);
    ASSERT_TRUE(p.found);
    EXPECT_NEAR(p.radius, 0.5 * width, wanted_error);
    ASSERT_TRUE(p.opening);
    EXPECT_EQ(p.opening->kind, Opening::Kind::gap);
    EXPECT_GT(std::abs(p.opening->direction.y), 0.999);
    EXPECT_EQ(p.way.front(), one_end);
    EXPECT_EQ(p.way.back(), other_end);
  }
}

TEST(Flight, IsProvenToSomeMillimetres) {
  const Survey survey = survey_to_fly(rooms(-0.1, 0.5, 0.0, 2.0));
  for (const double spacing : {0.2, 0.1}) {
    const Passage p = roam::widest_way(survey, one_end, other_end, {.mode = Mode::fly, .spacing = spacing});
    EXPECT_TRUE(p.proven);
    EXPECT_GE(p.bound, 0.3);
    EXPECT_LT(p.bound, 0.305);
  }
  const Passage open =
      roam::widest_way(survey, one_end, one_end + Vec3(0.3, 0.0, 0.0), {.mode = Mode::fly, .widest = 0.5});
  EXPECT_EQ(open.bound, std::numeric_limits<double>::infinity());
}

TEST(Flight, DoesNotDependOnWhereTheSceneLies) {
  for (const Vec3& by : {Vec3(-13739.0, 253.0, 182.0), Vec3(1e5, -1e5, 0.0)}) {
    Mesh m = rooms(-0.1, 0.5, 0.0, 2.0);
    for (Vec3& v : m.vertices) v += by;
    const Passage p = roam::widest_way(survey_to_fly(m), one_end + by, other_end + by, flying);
    EXPECT_NEAR(p.radius, 0.3, wanted_error);
    EXPECT_TRUE(p.proven);
  }
}

TEST(Flight, ComesFromFarOutsideTheScene) {
  // Down by the roof that is not there, and in by the door.
  const Mesh m = rooms(-0.1, 0.5, 0.0, 2.0, false);
  const Passage down = roam::widest_way(survey_to_fly(m), {40.0, -70.0, 90.0}, other_end, flying);
  EXPECT_TRUE(down.found);
  EXPECT_FALSE(down.limited);
  EXPECT_LT(down.places, 100'000u);
  const Passage closed =
      roam::widest_way(survey_to_fly(rooms(-0.1, 0.5, 0.0, 2.0)), {40.0, -70.0, 90.0}, other_end, flying);
  EXPECT_FALSE(closed.found);
  EXPECT_LT(closed.bound, 0.2);
  const Passage nothing = roam::widest_way(survey_to_fly({}), {0.0, 0.0, 0.0}, {3.0, 1.0, 2.0}, flying);
  EXPECT_TRUE(nothing.found);
  EXPECT_FALSE(nothing.limited);
}

TEST(Flight, BreaksOffWhereBothSidesAreNearest) {
  Mesh m = rooms(0.2, 0.2, 0.0, 2.0);
  const Passage flat = roam::widest_way(survey_to_fly(m), one_end, other_end, {.mode = Mode::fly, .spacing = 0.1});
  EXPECT_FALSE(flat.found);
  ASSERT_TRUE(flat.opening);
  EXPECT_NEAR(flat.opening->point.x, 0.0, 0.1);
  EXPECT_GT(std::abs(flat.opening->direction.x), 0.99);
  // Nothing comes near what is 2.4 m away.
  m = rooms(0.2, 0.2, 0.0, 2.0);
  add_box(m, {-1.2, -1.5, 0.0}, {1.2, 1.5, 2.6});
  const Passage far = roam::widest_way(survey_to_fly(m), one_end, other_end, {.mode = Mode::fly, .spacing = 0.1});
  EXPECT_FALSE(far.found || far.opening);
}

TEST(Flight, LooksForTheWidestThatIsAskedFor) {
  // The door is 2 mm narrower than what is looked for at most.
  const Passage p = roam::widest_way(survey_to_fly(rooms(-0.1, 0.5, 0.0, 2.0)), one_end, other_end,
                                     {.mode = Mode::fly, .widest = 0.302});
  EXPECT_TRUE(p.found && p.limited && p.proven);
  EXPECT_LE(p.bound, 0.302);
}

TEST(Flight, IsHalfTheSmallerSideOfAWindow) {
  const Passage p = roam::widest_way(survey_to_fly(rooms(-0.33, 0.33, 1.1, 1.52)), one_end, other_end, flying);
  ASSERT_TRUE(p.found);
  EXPECT_NEAR(p.radius, 0.21, wanted_error);
  ASSERT_TRUE(p.opening);
  EXPECT_NEAR(p.opening->point.z, 1.31, 0.01);
  EXPECT_GT(std::abs(p.opening->direction.z), 0.999);
}

TEST(Flight, IsHalfTheNarrowestDoorOfSeededGalleries) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const seeded::Gallery g = seeded::gallery(seed);
    const Vec3 up(0.0, 0.0, 1.2);
    const Passage p = roam::widest_way(survey_to_fly(g.mesh), g.from + up, g.to + up, flying);
    EXPECT_NEAR(p.radius, g.upper(), wanted_error) << seed;
    EXPECT_TRUE(p.proven) << seed;
    EXPECT_GE(p.bound, g.upper()) << seed;
  }
}

TEST(Flight, GoesOverTheWallWhereThereIsNoRoof) {
  const Passage p = roam::widest_way(survey_to_fly(rooms(-0.25, 0.25, 0.0, 2.0, false)), one_end, other_end, flying);
  ASSERT_TRUE(p.found);
  EXPECT_FALSE(p.limited);
  double highest = 0.0;
  for (const Vec3& v : p.way) highest = std::max(highest, v.z);
  EXPECT_GT(highest, 3.5);
}

TEST(Flight, IsFlownByABodyALittleSlimmer) {
  const Mesh m = rooms(-0.33, 0.33, 1.1, 1.52);
  const Survey survey = survey_to_fly(m);
  const Passage p = roam::widest_way(survey, one_end, other_end, flying);
  for (const double share : {0.97, 1.02}) {
    roam::Walker walker(survey.world(), roam::WalkerSettings::sphere(share * p.radius), Mode::fly, p.way.front());
    EXPECT_EQ(roam::follow(walker, p.way).outcome, share < 1.0 ? roam::Outcome::reached : roam::Outcome::blocked);
  }
  const Judge judge(m);
  for (std::size_t i = 1; i < p.way.size(); ++i) {
    EXPECT_GE(judge.over({p.radius, 0.0}, p.way[i - 1], p.way[i] - p.way[i - 1], 1.0), p.radius - 5e-4 - 1e-6);
  }
}

TEST(Flight, EndsAtAClosedWall) {
  Mesh m = rooms(0.0, 0.0, 0.0, 2.6);
  const Passage p = roam::widest_way(survey_to_fly(m), one_end, other_end, flying);
  EXPECT_FALSE(p.found);
  ASSERT_TRUE(p.opening);
  EXPECT_LT(std::abs(p.opening->point.x), 0.3);
}

TEST(Flight, IsHalfOfWhatIsNarrowestAcrossAnObliqueDuct) {
  // 0.5 m high in the wall, and rising by 3 m on 4: 0.4 m across.
  const Survey survey = survey_to_fly(flight::joined_by_duct(0.6, 0.5, 4.0, 3.0));
  const Passage p = roam::widest_way(survey, {-2.5, 0.3, 1.5}, {6.5, 0.2, 4.4}, flying);
  ASSERT_TRUE(p.found);
  EXPECT_NEAR(p.radius, 0.2, wanted_error);
  ASSERT_TRUE(p.opening);
  EXPECT_NEAR(std::abs(p.opening->direction.z), 0.8, 0.01);
  EXPECT_GE(p.bound, p.radius);
}

TEST(Flight, GoesUpAShaft) {
  const Passage p =
      roam::widest_way(survey_to_fly(flight::joined_by_shaft(0.7, 4.0)), {1.0, 1.0, 1.0}, {-1.0, 0.5, 8.5}, flying);
  ASSERT_TRUE(p.found);
  EXPECT_NEAR(p.radius, 0.35, wanted_error);
}

TEST(Flight, TakesTheWiderOfADoorAndAWindow) {
  for (const double window : {0.4, 0.9}) {
    const Mesh m = flight::joined_by_openings({{0.5, 1.1, 0.0, 2.0}, {2.2, 2.2 + window, 1.0, 1.0 + window}});
    const Passage p = roam::widest_way(survey_to_fly(m), {-2.5, 0.0, 1.5}, {2.5, 0.0, 1.5}, flying);
    ASSERT_TRUE(p.found);
    EXPECT_NEAR(p.radius, 0.5 * std::max(window, 0.6), wanted_error);
  }
}

TEST(Flight, TakesTheWiderOfTwoDoorsThatHardlyDiffer) {
  for (const double more : {-0.03, -0.012, 0.012, 0.03}) {
    const Mesh m = flight::joined_by_openings({{0.53, 1.13, 0.0, 2.0}, {2.17, 2.77 + more, 0.0, 2.0}});
    const Passage p = roam::widest_way(survey_to_fly(m), {-2.5, 0.0, 1.5}, {2.5, 0.0, 1.5}, flying);
    ASSERT_TRUE(p.found);
    EXPECT_NEAR(p.radius, 0.3 + std::max(0.0, 0.5 * more), wanted_error) << more;
    EXPECT_TRUE(p.proven) << more;
  }
}

/// Two halls of 30 m by 30 m by 10 m with a door between them, 0.8 m wide and 2 m high.
Mesh halls() {
  Mesh m;
  const double far = 30.0, side = 15.0, top = 10.0, door = 5.0, width = 0.8;
  for (const double z : {0.0, top}) add_floor(m, -far, -side, far, side, z);
  for (const double y : {-side, side}) add_wall(m, -far, y, far, y, 0.0, top);
  for (const double x : {-far, far}) add_wall(m, x, -side, x, side, 0.0, top);
  add_wall(m, 0.0, -side, 0.0, door, 0.0, top);
  add_wall(m, 0.0, door + width, 0.0, side, 0.0, top);
  add_wall(m, 0.0, door, 0.0, door + width, 2.0, top);
  return m;
}

TEST(Flight, LooksAtOpenAirInLargeCubes) {
  // On a lattice of 0.2 m these are 2.2 million places.
  const Passage p = roam::widest_way(survey_to_fly(halls()), {-20.0, -10.0, 5.0}, {20.0, -10.0, 3.0}, flying);
  ASSERT_TRUE(p.found);
  EXPECT_NEAR(p.radius, 0.4, wanted_error);
  EXPECT_TRUE(p.proven);
  EXPECT_LT(p.places, 700'000u);
}

TEST(Flight, SaysWhenItCameToItsMostPlaces) {
  const Survey survey = survey_to_fly(rooms(0.0, 0.0, 0.0, 2.6));
  const Passage whole = roam::widest_way(survey, one_end, other_end, flying);
  EXPECT_FALSE(whole.found);
  EXPECT_TRUE(whole.complete);
  const Passage ended = roam::widest_way(survey, one_end, other_end, {.mode = Mode::fly, .most_places = 500});
  EXPECT_FALSE(ended.found);
  EXPECT_FALSE(ended.complete);
  EXPECT_LT(ended.places, 2 * whole.places);
  EXPECT_GE(ended.bound, whole.bound);
  const Passage told = roam::widest_way(survey, one_end, other_end,
                                        {.mode = Mode::fly, .progress = [](std::uint64_t) { return false; }});
  EXPECT_FALSE(told.complete);
}

TEST(Flight, CertifiesThatAClosedWallLetsNobodyThrough) {
  const Passage p = roam::widest_way(survey_to_fly(rooms(0.0, 0.0, 0.0, 2.6)), one_end, other_end, flying);
  EXPECT_FALSE(p.found);
  EXPECT_LT(p.bound, 0.2);
}

}  // namespace
