// The judge of the benchmarks counts what it says it counts: a judge that sees nothing makes every engine perfect.

#include "bench/judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace roam::bench {
namespace {

constexpr double radius = 0.5;
const Query towards_wall{.body = {.radius = radius}, .from = Vec3(0.0), .motion = {10.0, 0.0, 0.0}};
constexpr double touch = 0.45;  // the wall is at x = 5

Reference nearby_wall() {
  const Mesh wall{.name = "wall", .vertices = {{5, -9, -9}, {5, 9, -9}, {5, 0, 18}}, .triangles = {{0, 1, 2}}};
  return Reference({&wall, 1});
}

Verdict verdict(const Reference& reference, const Query& query, const Answer& answer, bool says_when = true) {
  const Answer truth = reference.sweep(query);
  return judge({&answer, 1}, {&truth, 1}, {&query, 1}, reference, says_when);
}

Verdict at(double metres) { return verdict(nearby_wall(), towards_wall, {true, touch + metres / 10.0}); }

// A sphere that flies past the free edge of the wall, at `gap` metres from it.
Verdict past_edge(double gap, const Answer& answer) {
  Query query = towards_wall;
  query.from.z = -9.0 - radius - gap;
  return verdict(nearby_wall(), query, answer);
}

TEST(BenchJudge, AcceptsAnswersWithinTheDepthAndTheGapAllowed) {
  EXPECT_EQ(at(0.0).wrong(), 0U);
  EXPECT_EQ(at(0.9 * depth_allowed).wrong(), 0U);
  EXPECT_EQ(at(-0.9 * gap_allowed).wrong(), 0U);
}

TEST(BenchJudge, CountsLateAndEarlyAnswers) {
  EXPECT_EQ(at(1.1 * depth_allowed).late, 1U);
  EXPECT_NEAR(at(1.1 * depth_allowed).deepest, 1.1 * depth_allowed, 1e-12);
  EXPECT_EQ(at(-1.1 * gap_allowed).early, 1U);
}

TEST(BenchJudge, CountsABodyThatCameOutBehindTheWallAsDeepAsItWas) {
  const Verdict missed = verdict(nearby_wall(), towards_wall, {false, 1.0});
  EXPECT_EQ(missed.missed, 1U);
  EXPECT_NEAR(missed.deepest, radius, 1e-9);
  const Verdict late = verdict(nearby_wall(), towards_wall, {true, 0.9});
  EXPECT_EQ(late.late, 1U);
  EXPECT_NEAR(late.deepest, radius, 1e-9);
}

TEST(BenchJudge, ForgivesAGrazeButNotMore) {
  EXPECT_EQ(past_edge(-0.9 * depth_allowed, {false, 1.0}).wrong(), 0U);
  EXPECT_EQ(past_edge(-1.1 * depth_allowed, {false, 1.0}).missed, 1U);
  EXPECT_EQ(past_edge(0.9 * gap_allowed, {true, 0.5}).wrong(), 0U);
  EXPECT_EQ(past_edge(1.1 * gap_allowed, {true, 0.5}).false_hits, 1U);
}

TEST(BenchJudge, AsksEnginesWithoutATimeOnlyForHitOrFree) {
  EXPECT_EQ(verdict(nearby_wall(), towards_wall, {true, 0.0}, false).wrong(), 0U);
  EXPECT_EQ(verdict(nearby_wall(), towards_wall, {false, 0.0}, false).missed, 1U);
  Query away = towards_wall;
  away.motion = -away.motion;
  EXPECT_EQ(verdict(nearby_wall(), away, {true, 0.0}, false).false_hits, 1U);
}

TEST(BenchReference, TouchesFaceEdgeAndVertexWhenTheyAreARadiusAway) {
  const Reference reference = nearby_wall();
  EXPECT_DOUBLE_EQ(reference.sweep(towards_wall).time, touch);
  Query query = towards_wall;
  query.from.z = -9.3;  // 0.3 m below the lower edge: 3-4-5
  EXPECT_DOUBLE_EQ(reference.sweep(query).time, 0.46);
  query.from.z = 18.4;  // 0.4 m above the top
  EXPECT_DOUBLE_EQ(reference.sweep(query).time, 0.47);
}

TEST(BenchReference, TouchesWithTheAxisOfACapsule) {
  const Reference reference = nearby_wall();
  Query query = towards_wall;
  query.body.half_height = 2.0;
  query.from.z = -11.3;  // the axis ends 0.3 m below the lower edge
  EXPECT_DOUBLE_EQ(reference.sweep(query).time, 0.46);
  query.from.z = -10.0;  // the axis overlaps the edge
  EXPECT_DOUBLE_EQ(reference.sweep(query).time, touch);
  EXPECT_NEAR(reference.clearance(query.body, query.from, 9.0), 5.0, 1e-15);
}

}  // namespace
}  // namespace roam::bench
