// Tasks of a plan: balanced, without gaps, always the same.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "clutter.h"
#include "store/build/tasks.h"
#include "store_builds.h"

namespace {

using namespace roam::store;

/// A plan of shards as they are: many about full, some small ones at borders.
Plan plan_of(std::size_t shards, std::uint32_t seed) {
  clutter::Random random(seed);
  Plan plan;
  for (std::size_t i = 0; i < shards; ++i) {
    PlannedShard& shard = plan.shards.emplace_back();
    shard.stretch.triangles =
        static_cast<std::uint64_t>(i % 7 == 3 ? random.between(1.0, 4e5) : random.between(5e5, 1e6));
    shard.in_force = i % 10 == 9;
  }
  return plan;
}

/// The longest task divided by the mean.
double balance(const Plan& plan) {
  std::uint64_t all = 0;
  for (const std::size_t i : plan.to_build()) all += plan.shards[i].stretch.triangles;
  return static_cast<double>(longest_task(plan)) * static_cast<double>(plan.tasks) / static_cast<double>(all);
}

TEST(StoreTasks, HaveEachShardOnceAndAreNeverEmpty) {
  for (const std::uint64_t wished : {0, 1, 2, 17, 64, 179, 180, 181, 100000}) {
    Plan plan = plan_of(200, 1);
    assign_tasks(plan, wished);
    if (wished > 0) {
      EXPECT_EQ(plan.tasks, std::min<std::uint64_t>(wished, 180));
    }
    std::set<std::size_t> all;
    std::size_t sum = 0;
    for (std::uint64_t task = 0; task < plan.tasks; ++task) {
      const std::vector<std::size_t> shards = plan.to_build(task);
      EXPECT_FALSE(shards.empty()) << task;
      all.insert(shards.begin(), shards.end());
      sum += shards.size();
    }
    EXPECT_EQ(all.size(), 180U);
    EXPECT_EQ(sum, 180U);
    Plan again = plan_of(200, 1);
    assign_tasks(again, wished);
    for (std::size_t i = 0; i < 200; ++i) EXPECT_EQ(again.shards[i].task, plan.shards[i].task);
  }
}

TEST(StoreTasks, AreBalanced) {
  for (const std::size_t shards : {1, 2, 3, 10, 100, 3000, 30000}) {
    Plan plan = plan_of(shards, static_cast<std::uint32_t>(shards));
    assign_tasks(plan, 0);
    EXPECT_GE(plan.tasks, 1U);
    EXPECT_LE(plan.tasks, most_good_tasks);
    if (shards >= 100) {
      EXPECT_GE(plan.tasks, std::min<std::size_t>(shards / 2, most_good_tasks));
    }
    EXPECT_LE(balance(plan), good_balance);
    if (shards < 1000) continue;
    assign_tasks(plan, 64);
    EXPECT_LE(balance(plan), 1.01);
  }
}

TEST(StoreTasks, ShareOutLoadsOfAnySize) {
  clutter::Random random(5);
  std::vector<std::uint64_t> loads(3000);
  for (std::uint64_t& load : loads) load = static_cast<std::uint64_t>(random.between(1.0, 1e9));
  const std::vector<std::uint64_t> task_of = share_out(loads, 64);
  std::vector<std::uint64_t> sums(64);
  for (std::size_t i = 0; i < loads.size(); ++i) sums.at(task_of[i]) += loads[i];
  const auto [least, most] = std::minmax_element(sums.begin(), sums.end());
  EXPECT_LT(double(*most), 1.01 * double(*least));
  EXPECT_EQ(share_out(std::vector<std::uint64_t>{7, 9}, 1000), (std::vector<std::uint64_t>{1, 0}));
  EXPECT_TRUE(share_out({}, 3).empty());
}

TEST(StoreTasks, OfNothingAreNone) {
  Plan plan;
  assign_tasks(plan, 64);
  EXPECT_EQ(plan.tasks, 0U);
  EXPECT_EQ(longest_task(plan), 0U);
}

TEST(StoreTasks, AreReportedEachByItself) {
  const TestFolder folder;
  auto o = store_builds::options({store_builds::write_ply(folder.file("a.ply"), store_builds::field(760, 0.5, {}))},
                                 folder.file("s"));
  o.tasks = 2;
  roam::StoreBuildReport report;
  ASSERT_EQ(roam::plan_store(o, report), 2U);
  EXPECT_EQ(report.parts_read, 1U);
  EXPECT_EQ(report.triangles_to_build, report.triangles);
  for (const std::uint64_t task : {0, 1}) {
    roam::build_task(o, task, report);
    EXPECT_EQ(report.parts_read, 0U);
    EXPECT_EQ(report.shards_built, 1U);
    EXPECT_EQ(report.triangles_to_build, report.triangles);
  }
  roam::merge_store(o, report);
  EXPECT_EQ(report.shards_built, 0U);
  EXPECT_EQ(report.triangles_to_build, report.triangles);
  EXPECT_GT(report.read_seconds, 0.0) << "times add up";
}

TEST(StoreTasks, AreNamedByRanges) {
  const std::vector<std::uint64_t> numbers{0, 1, 2, 5, 7, 8};
  EXPECT_EQ(ranges_text(numbers, 9), "0-2,5,7-8");
  EXPECT_EQ(ranges_text(numbers, 2), "0-2,5,...");
  EXPECT_EQ(ranges_text({}, 2), "");
}

}  // namespace
