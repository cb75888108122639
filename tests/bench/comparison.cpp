// A comparison counts what engines get wrong, and keeps apart who was asked what.

#include "bench/comparison.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "roam/error.h"

namespace roam::bench {
namespace {

/// 100 spheres that fly at a wall at x = 5, and 100 that fly away from it.
QuerySet queries() {
  QuerySet set{.name = "made", .queries = {}};
  for (int i = 0; i < 200; ++i) {
    const double side = i % 2 == 0 ? 10.0 : -10.0;
    set.queries.push_back({.body = {.radius = 0.5}, .from = {0.0, 0.01 * i, 0.0}, .motion = {side, 0.0, 0.0}});
  }
  return set;
}

Reference wall_at_5() {
  const Mesh wall{.name = "wall", .vertices = {{5, -9, -9}, {5, 9, -9}, {5, 0, 18}}, .triangles = {{0, 1, 2}}};
  return Reference({&wall, 1});
}

Engine engine(const std::string& name, const std::function<Answer(const Query&)>& answer, double nanoseconds) {
  Engine made{.name = name, .used = "made up"};
  made.ask = [=](std::span<const Query> asked, std::span<double> times, std::span<Answer> answers) {
    for (std::size_t i = 0; i < asked.size(); ++i) {
      answers[i] = answer(asked[i]);
      times[i] = nanoseconds;
    }
  };
  return made;
}

std::vector<EngineRun> compared(const std::vector<Engine>& engines, const QuerySet& set, double patience = 10.0) {
  return compare(engines, set, wall_at_5(), {.rounds = 3, .patience = patience});
}

TEST(BenchComparison, CountsTheAnswersOfABrokenEngineAndOfARightOneApart) {
  const Reference reference = wall_at_5();
  const std::vector<Engine> engines{engine(
                                        "right", [&](const Query& q) { return reference.sweep(q); }, 2000.0),
                                    engine(
                                        "blind", [](const Query&) { return Answer{}; }, 10.0),
                                    engine(
                                        "timid",
                                        [](const Query&) {
                                          return Answer{true, 0.0};
                                        },
                                        20.0),
                                    engine(
                                        "slow to stop",
                                        [&](const Query& q) {
                                          const Answer answer = reference.sweep(q);
                                          return answer.hit ? Answer{true, answer.time + 0.01} : answer;
                                        },
                                        30.0)};
  const std::vector<EngineRun> runs = compared(engines, queries());
  ASSERT_EQ(runs.size(), 4U);
  EXPECT_EQ(runs[0].verdict.wrong(), 0U);
  EXPECT_EQ(runs[0].verdict.hits, 100U);
  EXPECT_EQ(runs[1].verdict.missed, 100U);
  EXPECT_NEAR(runs[1].verdict.deepest, 0.5, 1e-9);
  EXPECT_EQ(runs[2].verdict.early, 100U);
  EXPECT_EQ(runs[2].verdict.false_hits, 100U);
  EXPECT_EQ(runs[3].verdict.late, 100U);
  EXPECT_NEAR(runs[3].verdict.deepest, 0.1, 1e-9);
  EXPECT_EQ(runs[0].times.p50, 2000.0);
  EXPECT_EQ(runs[3].times.p99, 30.0);
}

TEST(BenchComparison, GivesAnEngineThatIsTooSlowTheFirstPart) {
  Engine sleepy = engine(
      "sleepy", [](const Query&) { return Answer{}; }, 1.0);
  const Ask quick = sleepy.ask;
  sleepy.ask = [quick](std::span<const Query> asked, std::span<double> times, std::span<Answer> answers) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    quick(asked, times, answers);
  };
  const std::vector<EngineRun> runs = compared({sleepy}, queries(), 0.01);
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_GT(runs[0].asked, 0U);
  EXPECT_LT(runs[0].asked, 200U);
  EXPECT_EQ(runs[0].verdict.queries, runs[0].asked);
}

TEST(BenchComparison, NamesAnEngineThatEndsAndGoesOnWithTheOthers) {
  const Reference reference = wall_at_5();
  const Engine right = engine(
      "right", [&](const Query& q) { return reference.sweep(q); }, 2000.0);
  Engine at_once = right, later = right;
  at_once.name = "at once";
  at_once.ask = [](auto&&...) { throw Error("ended early"); };
  later.name = "later";
  later.ask = [ask = right.ask](std::span<const Query> asked, std::span<double> times, std::span<Answer> answers) {
    // All answers are given; it ends while it is timed.
    if (asked.size() > 100) throw Error("out of memory");
    ask(asked, times, answers);
  };
  const std::vector<Engine> engines{at_once, right, later};
  const std::vector<EngineRun> runs = compared(engines, queries());
  ASSERT_EQ(runs.size(), 3U);
  EXPECT_EQ(runs[0].failure, "ended early");
  EXPECT_EQ(runs[1].failure, "");
  EXPECT_EQ(runs[1].verdict.hits, 100U);
  EXPECT_EQ(runs[1].times.p50, 2000.0);
  EXPECT_EQ(runs[2].failure, "out of memory");
  EXPECT_EQ(runs[2].verdict.queries, 0U) << "no verdict on half a run";
}

TEST(BenchTiming, TakesTheLowerOfTwoValuesThatAPartLiesBetween) {
  const std::vector<double> four{1.0, 2.0, 3.0, 4.0};
  EXPECT_EQ(quantile(four, 0.0), 1.0);
  EXPECT_EQ(quantile(four, 0.5), 2.0);
  EXPECT_EQ(quantile(four, 0.99), 3.0);
  EXPECT_EQ(quantile(four, 1.0), 4.0);
  EXPECT_EQ(quantile({}, 0.5), 0.0);
  std::vector<double> many;
  for (int i = 0; i <= 1000; ++i) many.push_back(i);
  EXPECT_EQ(quantile(many, 0.99), 990.0);
}

TEST(BenchComparison, EndsWhenItIsToldTo) {
  const Engine quick = engine(
      "quick", [](const Query&) { return Answer{}; }, 1.0);
  int calls = 0;
  const auto stop_at = [&](int last) {
    return [&calls, last] {
      if (++calls == last) throw Cancelled();
    };
  };
  const std::vector<Engine> engines{quick};
  const QuerySet set = queries();
  const ComparisonOptions whole{.rounds = 3, .patience = 10.0, .between = stop_at(-1)};
  ASSERT_EQ(compare(engines, set, wall_at_5(), whole).size(), 1U);
  // In each of its parts, the last round too.
  for (const int last : {1, calls / 2, calls}) {
    calls = 0;
    const ComparisonOptions options{.rounds = 3, .patience = 10.0, .between = stop_at(last)};
    EXPECT_THROW((void)compare(engines, set, wall_at_5(), options), Cancelled) << last;
  }
}

TEST(BenchComparison, AsksNoCapsuleOfAnEngineOfSpheres) {
  Engine spheres = engine(
      "spheres", [](const Query&) { return Answer{}; }, 1.0);
  spheres.spheres_only = true;
  const Engine both = engine(
      "both", [](const Query&) { return Answer{}; }, 1.0);
  QuerySet set = queries();
  EXPECT_EQ(compared({spheres, both}, set).size(), 2U);
  set.queries[7].body.half_height = 0.4;
  const std::vector<Engine> engines{spheres, both};
  const std::vector<EngineRun> runs = compared(engines, set);
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0].engine->name, "both");
}

TEST(BenchComparison, JudgesRaysByTheirWayBehindTheTouch) {
  const Reference reference = wall_at_5();
  QuerySet set = queries();
  set.kind = QueryKind::ray;
  for (Query& query : set.queries) query.body.radius = 0.0;
  Engine none = engine(
      "no rays", [](const Query&) { return Answer{}; }, 1.0);
  Engine blind = none, late = none;
  blind.rays = late.rays = true;
  late.ask = engine(
                 "",
                 [&](const Query& q) {
                   const Answer answer = reference.sweep(q);
                   return answer.hit ? Answer{true, answer.time + 1e-5} : answer;
                 },
                 1.0)
                 .ask;
  const std::vector<Engine> engines{none, blind, late};
  const std::vector<EngineRun> runs = compared(engines, set);
  ASSERT_EQ(runs.size(), 2U) << "an engine without rays is left out";
  EXPECT_EQ(runs[0].verdict.missed, 100U);
  EXPECT_NEAR(runs[0].verdict.deepest, 5.0, 1e-9);
  EXPECT_EQ(runs[1].verdict.late, 100U);
  EXPECT_NEAR(runs[1].verdict.deepest, 1e-4, 1e-9);
}

TEST(BenchComparison, JudgesDistancesThatAreTooGreatAsLate) {
  QuerySet set{.name = "made", .queries = {}, .kind = QueryKind::nearest};
  for (int i = 0; i < 10; ++i) set.queries.push_back({.body = {.radius = 0.0}, .from = {1.0 + 0.1 * i, 0.0, 0.0}});
  const auto answering = [](double more) {
    return engine(
               "", [more](const Query& q) { return Answer{.distance = 5.0 - q.from.x + more}; }, 7.0)
        .ask;
  };
  std::vector<Engine> engines(4);
  engines[1].nearest = answering(0.0);
  engines[2].nearest = answering(2e-5);
  engines[3].nearest = answering(-2e-3);
  const std::vector<EngineRun> runs = compared(engines, set);
  ASSERT_EQ(runs.size(), 3U) << "an engine without such queries is left out";
  EXPECT_EQ(runs[0].verdict.wrong(), 0U);
  EXPECT_EQ(runs[0].verdict.hits, 10U);
  EXPECT_EQ(runs[0].times.p50, 7.0);
  EXPECT_EQ(runs[1].verdict.late, 10U);
  EXPECT_NEAR(runs[1].verdict.deepest, 2e-5, 1e-9);
  EXPECT_EQ(runs[2].verdict.early, 10U);
}

}  // namespace
}  // namespace roam::bench
