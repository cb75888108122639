// The obstacle that a probe names, and the sizes that it says would pass.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "messages.h"
#include "probed_room.h"
#include "roam/probe.h"
#include "walker_scenes.h"
#include "words/probe.h"

namespace {

using namespace scenes;
using namespace roam;
using Kind = ProbeLimit::Kind;

TEST(ProbeLimits, AreNoneWhereAWalkerFallsIntoACrackHoweverShallow) {
  const ProbeAnswer answer = probe(survey_of(cracked(9.6, 10.4, 20.0, 0.65)), across, {.radius = 0.38, .height = 1.8});
  ASSERT_TRUE(answer.wide_enough && answer.walk);
  EXPECT_EQ(answer.walk->outcome, Outcome::fell);
  EXPECT_TRUE(words::report(across, answer).sentences().starts_with("NO:"));
}

TEST(ProbeLimits, AreADoorThatIsExactlyAsWideAsTheBody) {
  for (const double width : {0.6, 0.8}) {
    const Survey survey = survey_of(room(width), false);
    const ProbeAnswer answer = probe(survey, across, {.radius = 0.5 * width, .height = 1.8});
    EXPECT_FALSE(answer.wide_enough) << width;
    ASSERT_TRUE(answer.limit);
    EXPECT_EQ(answer.limit->kind, Kind::door) << width;
    EXPECT_LT(answer.missing, 1e-3);
    const std::string text = words::report(across, answer).sentences();
    EXPECT_TRUE(contains(text, "less than 1 mm too narrow") && !contains(text, "headroom")) << text;
  }
}

TEST(ProbeLimits, NameAWidthWithWhichAWalkerPasses) {
  for (const bool lossless : {false, true}) {
    for (const double width : {0.6, 0.6000000014, 0.60001, 0.6004, 0.5999}) {
      const Survey survey = survey_of(room(width), lossless);
      const ProbeAnswer answer = probe(survey, across, {.radius = 0.32, .height = 1.8});
      EXPECT_FALSE(answer.passable);
      EXPECT_GT(answer.passing, 0.5 * width - 2e-3) << width;
      EXPECT_LE(answer.passing, answer.passage.radius) << width;
      EXPECT_TRUE(probe(survey, across, {.radius = answer.passing, .height = 1.8}).passable) << width;
      const std::string printed = fmt::format("Would pass: up to {:.3f} m wide", 2.0 * answer.passing);
      const std::string text = words::report(across, answer).sentences();
      EXPECT_TRUE(contains(text, printed)) << text;
      EXPECT_NEAR(2000.0 * answer.passing, std::round(2000.0 * answer.passing), 1e-6) << "whole millimetres of width";
    }
  }
}

/// room(0.6), with a step up of 0.5 m or a lintel 1.5 m above the floor at x = 14.
Mesh room_with(bool step) {
  Mesh m = room(0.6);
  if (step) {
    add_floor(m, 14.0, -2.0, 20.0, 2.0, 0.5);
    add_wall(m, 14.0, -2.0, 14.0, 2.0, 0.0, 0.5);
  } else {
    add_wall(m, 14.0, -2.0, 14.0, 2.0, 1.5, 3.0);
  }
  return m;
}

TEST(ProbeLimits, AreTwoInARow) {
  for (const bool step : {true, false}) {
    const Survey survey = survey_of(room_with(step));
    const ProbeAnswer answer = probe(survey, across, {.radius = 0.35, .height = 1.8});
    EXPECT_FALSE(answer.passable);
    ASSERT_TRUE(answer.limit && answer.other) << words::report(across, answer).text();
    EXPECT_EQ(answer.limit->kind, step ? Kind::step : Kind::height);
    EXPECT_NEAR(answer.limit->size, step ? 0.5 : 1.5, 2e-3);
    EXPECT_EQ(answer.other->kind, Kind::door);
    const std::vector<words::ProbeMark> marks = words::marks_of(answer);
    ASSERT_EQ(marks.size(), 2U);
    EXPECT_EQ(marks[1].place, answer.other->point);
    words::ProbeDetails details;
    details.other_right = "right jamb";
    EXPECT_TRUE(contains(words::report(across, answer, details).sentences(), "right jamb"));
    EXPECT_NEAR(answer.other->size, 0.6, 1e-3);
    const std::string text = words::report(across, answer).sentences();
    EXPECT_TRUE(contains(text, step ? "Stopped by: step of 0.500 m" : "Stopped by: headroom 1.500 m")) << text;
    EXPECT_TRUE(contains(text, "And by: door 0.600 m wide") && contains(text, "0.100 m too narrow")) << text;
    EXPECT_FALSE(contains(text, "Would pass")) << text;
    const ProbeAnswer narrow = probe(survey, across, {.radius = 0.25, .height = 1.8});
    ASSERT_TRUE(narrow.limit);
    EXPECT_EQ(narrow.limit->kind, step ? Kind::step : Kind::height);
    EXPECT_FALSE(narrow.other);
  }
}

TEST(ProbeLimits, DoNotComeFromAnEndThatWasMovedToAPlaceWithoutRoom) {
  Mesh m = room(0.84);
  add_wall(m, 2.0, 0.0, 3.0, 0.0, 0.0, 1.2);
  ProbeQuestion question = across;
  question.from = {2.65, 0.01, 0.5};
  const ProbeAnswer answer = probe(survey_of(m), question, {.radius = 0.3, .height = 1.8});
  EXPECT_TRUE(answer.passable);
  EXPECT_GT(std::abs(answer.start.y), 0.3);
  const std::string text = words::report(question, answer).sentences();
  EXPECT_TRUE(contains(text, ", moved by 0.30 m: there is no room at (2.65, 0.01, 0.50)")) << text;
}

}  // namespace
