// The leads at the end of a run, by known numbers.

#include "bench/leads.h"

#include <gtest/gtest.h>

namespace roam::bench {
namespace {

const Engine roam{.name = "roam", .used = {}}, swift{.name = "swift", .used = {}}, slow{.name = "slow", .used = {}},
    vague{.name = "vague", .used = {}, .says_when = false};

EngineRun run(const Engine& engine, const char* set, double p50, double hit_p50, double p99) {
  EngineRun made;
  made.set = set;
  made.engine = &engine;
  made.times.p50 = p50;
  made.times.p99 = p99;
  made.times.hit_p50 = hit_p50;
  return made;
}

TEST(BenchLeads, CompareWithTheFastestOtherEngineInEachFigureOfItsOwn) {
  const std::vector<EngineRun> runs{run(roam, "random", 10.0, 100.0, 200.0), run(swift, "random", 5.0, 900.0, 800.0),
                                    run(slow, "random", 30.0, 300.0, 1000.0), run(vague, "random", 1.0, 1.0, 1.0)};
  const std::vector<LeadRow> rows = leads_in("cave", runs);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].scene, "cave");
  EXPECT_EQ(rows[0].set, "random");
  EXPECT_DOUBLE_EQ(rows[0].leads[0].times, 0.5);
  EXPECT_EQ(rows[0].leads[0].engine, "swift");
  EXPECT_DOUBLE_EQ(rows[0].leads[1].times, 3.0);
  EXPECT_EQ(rows[0].leads[1].engine, "slow");
  EXPECT_DOUBLE_EQ(rows[0].leads[2].times, 4.0);
}

TEST(BenchLeads, AreMultipliedNotAdded) {
  const std::vector<EngineRun> runs{run(roam, "random", 1.0, 1.0, 1.0), run(swift, "random", 2.0, 8.0, 1.0),
                                    run(roam, "long", 1.0, 1.0, 1.0), run(swift, "long", 8.0, 0.5, 16.0)};
  const std::vector<LeadRow> rows = leads_in("cave", runs);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_DOUBLE_EQ(summarize(rows, 0).mean, 4.0);
  EXPECT_DOUBLE_EQ(summarize(rows, 1).mean, 2.0);
  EXPECT_DOUBLE_EQ(summarize(rows, 2).mean, 4.0);
  EXPECT_EQ(summarize(rows, 0).worst, &rows[0]);
  EXPECT_EQ(summarize(rows, 1).worst, &rows[1]);
}

TEST(BenchLeads, LeaveOutRowsWithoutAnyTimeToCompare) {
  const std::vector<EngineRun> runs{run(roam, "random", 1.0, 0.0, 1.0), run(swift, "random", 2.0, 0.0, 3.0),
                                    run(roam, "long", 1.0, 1.0, 1.0), run(vague, "long", 2.0, 2.0, 2.0),
                                    run(swift, "capsule", 2.0, 2.0, 2.0)};
  const std::vector<LeadRow> rows = leads_in("cave", runs);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].leads[1].times, 0.0) << "nothing hits";
  EXPECT_EQ(summarize(rows, 1).worst, nullptr);
  EXPECT_DOUBLE_EQ(summarize(rows, 2).mean, 3.0);
  EXPECT_EQ(summarize({}, 0).worst, nullptr);
}

TEST(BenchLeads, LeaveOutRaysAndNearestPoints) {
  const Engine own{.name = "roam", .used = {}}, other{.name = "other", .used = {}};
  std::vector<EngineRun> runs(2);
  runs[0] = {.set = "rays", .engine = &own, .verdict = {}, .times = {.p50 = 1, .p99 = 1}, .failure = {}};
  runs[1] = {.set = "rays", .engine = &other, .verdict = {}, .times = {.p50 = 2, .p99 = 2}, .failure = {}};
  EXPECT_EQ(leads_in("made", runs).size(), 1U);
  runs[0].kind = runs[1].kind = QueryKind::ray;
  EXPECT_TRUE(leads_in("made", runs).empty());
}

}  // namespace
}  // namespace roam::bench
