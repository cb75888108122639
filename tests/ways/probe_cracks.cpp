// Ways over the cracks that a body spans, and round the holes that it falls into.
#include <gtest/gtest.h>

#include "floor_pieces.h"
#include "probed_room.h"
#include "roam/probe.h"
#include "walker_scenes.h"
#include "words/probe.h"

namespace {

using namespace scenes;
using namespace roam;

constexpr ProbedSize crossing_person{.radius = 0.3, .height = 1.8};

/// A floor of 20 m by 10 m with a square hole of 0.8 m on the straight way; `depth`: of its bottom, 0: it has none.
Mesh holed(double depth) {
  Mesh m;
  floors::Floor(0.0, -5.0, 20.0, 5.0, 2.0).without(floors::rectangle(6.6, -0.4, 7.4, 0.4)).add_to(m, 0.0);
  if (!(depth > 0.0)) return m;
  add_floor(m, 6.6, -0.4, 7.4, 0.4, -depth);
  for (const double x : {6.6, 7.4}) add_wall(m, x, -0.4, x, 0.4, -depth, 0.0);
  for (const double y : {-0.4, 0.4}) add_wall(m, 6.6, y, 7.4, y, -depth, 0.0);
  return m;
}

const ProbeQuestion over_hole{.from = {2.0, 0.0, 1.0}, .to = {12.0, 0.0, 1.0}};

TEST(ProbeCracks, AreGoneRoundWhereTheBodyFallsAndThereIsRoom) {
  for (const double depth : {0.0, 1.0}) {
    const Survey survey = survey_of(holed(depth));
    const ProbeAnswer answer = probe(survey, over_hole, crossing_person);
    ASSERT_TRUE(answer.passable && answer.walk) << words::report(over_hole, answer).text();
    EXPECT_EQ(answer.walk->outcome, Outcome::reached);
    EXPECT_FALSE(answer.passage.limited);
    EXPECT_GT(answer.passage.length, 10.02);
    ProbeQuestion carried = over_hole;
    carried.support_radius = 0.45;
    EXPECT_NEAR(probe(survey, carried, crossing_person).passage.length, 10.0, 0.01);
  }
}

TEST(ProbeCracks, LetNobodyStandOverThem) {
  ProbeQuestion question = over_hole;
  question.to = {7.0, 0.0, 0.05};
  const ProbeAnswer answer = probe(survey_of(holed(0.0)), question, crossing_person);
  EXPECT_FALSE(answer.passable) << words::report(question, answer).text();
}

TEST(ProbeCracks, AreCrossedByADiscLargerThanAMetre) {
  const Survey survey = survey_of(cracked(5.0, 7.4, 15.0, 5.0));
  ProbeQuestion question = over_hole;
  for (const double disc : {1.25, 1.5}) {
    question.support_radius = disc;
    const ProbeAnswer answer = probe(survey, question, crossing_person);
    EXPECT_TRUE(answer.passable) << words::report(question, answer).text();
  }
  question.support_radius = 1.15;
  EXPECT_FALSE(probe(survey, question, crossing_person).passable);
}

TEST(ProbeCracks, AreNoneOnOpenFloorForABodyHardlyHigherThanASphere) {
  for (const bool lossless : {true, false}) {
    Mesh m;
    add_floor(m, 0.0, -5.0, 20.0, 5.0, 0.0);
    const Survey survey = survey_of(m, lossless);
    for (const ProbedSize& size : {ProbedSize{0.8985, 1.8}, ProbedSize{0.3, 0.604}, ProbedSize{0.3, 0.6 + 1e-9}}) {
      const ProbeAnswer answer = probe(survey, over_hole, size);
      EXPECT_TRUE(answer.passable) << words::report(over_hole, answer).text();
    }
  }
}

}  // namespace
