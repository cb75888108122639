// Flying in real scenes: answers that were looked at by eye (docs/proofs.md, "Trained"), in few places.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "import_files.h"
#include "roam/import.h"
#include "roam/passage.h"
#include "roam/route.h"
#include "roam/train.h"
#include "words/training.h"

namespace roam::test {
namespace {

using words::answer;

Survey survey_of(const std::string& scene) {
  return Survey::build(import_scene(test_data() / scene).meshes, {.lossless = true, .progress = {}});
}

Passage flown(const Survey& survey, const Vec3& from, const Vec3& to) {
  return widest_way(survey, from, to, {.mode = Mode::fly});
}

/// A walker of 0.97 of what passes gets through.
void expect_flown(const Survey& survey, const Passage& passage) {
  Walker walker(survey.world(), WalkerSettings::sphere(0.97 * passage.radius), Mode::fly, passage.way.front());
  EXPECT_EQ(follow(walker, passage.way).outcome, Outcome::reached);
}

TEST(FlyRealScenes, CrossesATunnelInFewPlaces) {
  ROAM_NEEDS_TEST_DATA();
  const Survey survey = survey_of("underground/subt_tunnel_practice_1.osgb");
  // Straight on for 60 m, nothing as narrow as a metre.
  const Passage wide = flown(survey, {100.0, 0.0, -18.4}, {160.0, 0.0, -18.4});
  EXPECT_TRUE(wide.found);
  EXPECT_FALSE(wide.limited);
  EXPECT_NEAR(wide.length, 60.0, 1.0);
  EXPECT_LT(wide.places, 100'000u);
  // Down a ramp, from beside its roof: that decides.
  const Passage ramp = flown(survey, {20.0, 0.0, -3.4}, {80.0, 0.0, -18.4});
  ASSERT_TRUE(ramp.limited && ramp.opening);
  EXPECT_NEAR(ramp.radius, 0.8547, 1e-3);
  EXPECT_TRUE(ramp.proven);
  EXPECT_GT(std::abs(ramp.opening->direction.z), 0.9);
  EXPECT_LT(ramp.places, 200'000u);
  expect_flown(survey, ramp);
}

TEST(FlyRealScenes, GoesRoundWhereThatIsWider) {
  ROAM_NEEDS_TEST_DATA();
  const Survey survey = survey_of("underground/subt_tunnel_practice_1.osgb");
  const Passage p = flown(survey, {160.0, 0.0, -18.4}, {180.0, 0.0, -18.4});
  ASSERT_TRUE(p.found);
  EXPECT_NEAR(p.radius, 0.9749, 1e-3);
  EXPECT_GT(p.length, 300.0);
  EXPECT_TRUE(p.proven);
}

TEST(FlyRealScenes, GetsOutOfATunnelByItsMouth) {
  ROAM_NEEDS_TEST_DATA();
  const Survey survey = survey_of("underground/subt_tunnel_practice_1.osgb");
  const Passage p = flown(survey, {100.0, 0.0, -18.4}, {100.0, 30.0, 3.0});
  ASSERT_TRUE(p.found);
  EXPECT_FALSE(p.limited);
  EXPECT_GT(p.length, 150.0);
  EXPECT_LT(p.places, 1'000'000u);
}

TEST(FlyRealScenes, GetsOutFromUnderTheFurnitureOfAHouse) {
  ROAM_NEEDS_TEST_DATA();
  const Survey survey = survey_of("building/small_house.glb");
  const Passage p = flown(survey, {6.53, 1.52, 0.24}, {0.0, 0.0, 1.5});
  ASSERT_TRUE(p.limited && p.opening);
  EXPECT_NEAR(p.radius, 0.2376, 1e-3);
  EXPECT_TRUE(p.proven);
  expect_flown(survey, p);
}

TEST(FlyRealScenes, TrainsInAMineAndNoTrialContradictsIt) {
  ROAM_NEEDS_TEST_DATA();
  TrainOptions options;
  options.mode = Mode::fly;
  const Training t = train(survey_of("underground/pittsburgh_mine.dae"), options);
  EXPECT_TRUE(t.feasible) << answer(t);
  EXPECT_TRUE(t.contradictions.empty()) << roam::words::contradiction(t.contradictions.front());
}

}  // namespace
}  // namespace roam::test
