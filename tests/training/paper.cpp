// The paper's procedure: adjusting the radius by what becomes of bodies on their paths.
#include <gtest/gtest.h>

#include <cmath>

#include "train_scenes.h"
#include "training/paper.h"
#include "ways/trials/trials.h"

namespace {

using roam::Outcome;
using roam::Survey;
using roam::Trial;
using roam::Vec3;
using roam::training::adjust_radius;
using roam::training::PaperOptions;
using roam::training::PaperRun;
using roam::ways::BodyKind;
using Ending = PaperRun::Ending;

/// A path that bodies of [smallest, largest] pass.
struct Limits {
  double smallest, largest;
};

PaperRun adjust(const std::vector<Limits>& paths, const PaperOptions& options = {}) {
  return adjust_radius(paths.size(), options, [&](std::size_t path, double radius) {
    Trial trial{.radius = radius, .path = path};
    if (radius < paths[path].smallest) trial.outcome = Outcome::fell;
    if (radius > paths[path].largest) trial.outcome = Outcome::blocked;
    return std::optional(trial);
  });
}

TEST(AdjustedRadius, StaysWhereEveryPathIsPassedAtOnce) {
  const PaperRun r = adjust({{0.0, 1.0}, {0.1, 0.5}, {0.29, 0.31}});
  EXPECT_EQ(r.ending, Ending::settled);
  EXPECT_DOUBLE_EQ(r.radius, 0.3);
  EXPECT_EQ(r.trials.size(), 3u);
  EXPECT_FALSE(r.fallen);
  EXPECT_FALSE(r.blocked);
}

TEST(AdjustedRadius, GoesDownWhereABodyCannotEnterAndUpWhereItFliesOff) {
  const PaperRun down = adjust({{0.0, 0.2}});
  EXPECT_EQ(down.ending, Ending::settled);
  EXPECT_LE(down.radius, 0.2);
  const PaperRun up = adjust({{0.7, 1.0}});
  EXPECT_EQ(up.ending, Ending::settled);
  EXPECT_GE(up.radius, 0.7);
}

TEST(AdjustedRadius, RoamsEarlierPathsAgainWithWhatALaterOneChanged) {
  // The second path asks for more than the first takes at once: between them 0.5 to 0.55 is left.
  const std::vector<Limits> paths{{0.0, 0.55}, {0.5, 1.0}};
  const PaperRun r = adjust(paths);
  ASSERT_EQ(r.ending, Ending::settled);
  EXPECT_GE(r.radius, 0.5);
  EXPECT_LE(r.radius, 0.55);
  for (std::size_t path = 0; path < paths.size(); ++path) {
    const bool passed = std::any_of(r.trials.begin(), r.trials.end(), [&](const Trial& t) {
      return t.path == path && t.radius == r.radius && t.outcome == Outcome::reached;
    });
    EXPECT_TRUE(passed) << path;
  }
}

TEST(AdjustedRadius, NamesTheTwoTrialsThatContradictEachOther) {
  const PaperRun r = adjust({{0.0, 0.4}, {0.625, 1.0}});
  EXPECT_EQ(r.ending, Ending::contradiction);
  ASSERT_TRUE(r.fallen && r.blocked);
  EXPECT_EQ(r.blocked->path, 0u);
  EXPECT_EQ(r.fallen->path, 1u);
  EXPECT_LE(r.blocked->radius - r.fallen->radius, 0.01);
}

TEST(AdjustedRadius, EndsWhereNotEvenTheSmallestEntersOrTheLargestIsCarried) {
  EXPECT_EQ(adjust({{0.0, 0.01}}).ending, Ending::too_small);
  EXPECT_EQ(adjust({{2.0, 3.0}}).ending, Ending::too_large);
}

TEST(AdjustedRadius, TriesEachPathTwentyTimesAtMost) {
  PaperOptions options;
  options.precision = 0.0;
  const PaperRun r = adjust({{0.4, 0.4 - 1e-9}}, options);
  EXPECT_EQ(r.ending, Ending::out_of_trials);
  EXPECT_EQ(r.trials.size(), 20u);
}

TEST(AdjustedRadius, EndsWhenItIsToldTo) {
  int asked = 0;
  const PaperRun r = adjust_radius(3, {}, [&](std::size_t path, double radius) -> std::optional<Trial> {
    if (++asked == 2) return std::nullopt;
    return Trial{.radius = radius, .path = path};
  });
  EXPECT_EQ(r.ending, Ending::cancelled);
  EXPECT_EQ(r.trials.size(), 1u);
  EXPECT_DOUBLE_EQ(r.radius, 0.3);
}

// ---------------------------------------------------------------------------------------------- with a real walker

constexpr BodyKind sphere{};

Trial tried(const Survey& survey, double radius, const std::vector<Vec3>& way, const BodyKind& kind = sphere) {
  return roam::ways::try_way(survey, kind, radius, 0.0, way);
}

TEST(ATrial, IsBlockedByADoorThatIsTooNarrowAndPassesAWiderOne) {
  const Survey survey = corridor({.door = 0.8});
  EXPECT_EQ(tried(survey, 0.39, corridor_way).outcome, Outcome::reached);
  EXPECT_EQ(tried(survey, 0.41, corridor_way).outcome, Outcome::blocked);
}

TEST(ATrial, FallsIntoASplitThatIsTooWideHoweverShallowItIs) {
  for (const double depth : {0.5, 3.0, 14.0}) {
    const Survey survey = corridor({.split = 0.6, .depth = depth});
    EXPECT_EQ(tried(survey, 0.29, corridor_way).outcome, Outcome::fell) << depth;
    EXPECT_EQ(tried(survey, 0.34, corridor_way).outcome, Outcome::reached) << depth;
  }
}

TEST(ATrial, IsHeldWhereTheBodyDoesNotFitAtTheStart) {
  const Survey survey = corridor({.door = 0.8});
  EXPECT_EQ(tried(survey, 0.3, {{0.25, 1.85, 0.0}, {5.0, 0.0, 0.0}}).outcome, Outcome::held);
}

TEST(ATrial, OfACapsuleDoesNotCrouch) {
  const Survey survey = corridor({.door = 0.8, .lintel = 1.7});
  BodyKind person{.height = 1.8};
  EXPECT_EQ(tried(survey, 0.3, corridor_way, person).outcome, Outcome::blocked);
  person.height = 1.6;
  EXPECT_EQ(tried(survey, 0.3, corridor_way, person).outcome, Outcome::reached);
}

TEST(ATrial, FliesWithoutFalling) {
  const Survey survey = corridor({.door = 0.8, .split = 1.0});
  std::vector<Vec3> way = corridor_way;
  for (Vec3& place : way) place.z += 1.0;
  BodyKind flying{.mode = roam::Mode::fly};
  EXPECT_EQ(tried(survey, 0.39, way, flying).outcome, Outcome::reached);
  EXPECT_EQ(tried(survey, 0.41, way, flying).outcome, Outcome::blocked);
}

TEST(ThePapersProcedure, SettlesBetweenTheSplitAndTheDoor) {
  const Survey survey = corridor({.door = 1.2, .split = 0.8});
  const PaperRun r = adjust_radius(1, {}, [&](std::size_t path, double radius) {
    Trial trial = tried(survey, radius, corridor_way);
    trial.path = path;
    return std::optional(trial);
  });
  EXPECT_EQ(r.ending, Ending::settled);
  EXPECT_GT(r.radius, 0.4);
  EXPECT_LT(r.radius, 0.6);
  ASSERT_TRUE(r.fallen);
  EXPECT_DOUBLE_EQ(r.fallen->radius, 0.3);
}

TEST(ThePapersProcedure, FindsNoRadiusWhereTheSplitIsWiderThanTheDoor) {
  const Survey survey = corridor({.door = 0.8, .split = 1.25});
  const PaperRun r = adjust_radius(
      1, {}, [&](std::size_t, double radius) { return std::optional(tried(survey, radius, corridor_way)); });
  EXPECT_EQ(r.ending, Ending::contradiction);
}

}  // namespace
