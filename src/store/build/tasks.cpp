#include "store/build/tasks.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace roam::store {
namespace {

/// The loads of tasks, after each shard has gone to the least loaded one. The longest shard comes first: then the
/// longest task is at most 4/3 of the best possible one (Graham 1969).
std::vector<std::uint64_t> share_out(Plan& plan, std::span<const std::size_t> longest_first, std::uint64_t tasks) {
  using Load = std::pair<std::uint64_t, std::uint64_t>;  // triangles, task
  std::priority_queue<Load, std::vector<Load>, std::greater<>> least;
  std::vector<std::uint64_t> loads(tasks);
  for (std::uint64_t t = 0; t < tasks; ++t) least.push({0, t});
  for (const std::size_t i : longest_first) {
    PlannedShard& shard = plan.shards[i];
    shard.task = least.top().second;
    least.pop();
    loads[shard.task] += shard.stretch.triangles;
    least.push({loads[shard.task], shard.task});
  }
  return loads;
}

}  // namespace

void assign_tasks(Plan& plan, std::uint64_t wished) {
  std::vector<std::size_t> shards = plan.to_build();
  std::stable_sort(shards.begin(), shards.end(), [&](std::size_t a, std::size_t b) {
    return plan.shards[a].stretch.triangles > plan.shards[b].stretch.triangles;
  });
  plan.tasks = std::min<std::uint64_t>(wished > 0 ? wished : most_good_tasks, shards.size());
  if (plan.tasks == 0) return;
  for (std::uint64_t triangles = 0;; triangles = 0) {
    const std::vector<std::uint64_t> loads = share_out(plan, shards, plan.tasks);
    for (const std::uint64_t load : loads) triangles += load;
    const auto longest = static_cast<double>(*std::max_element(loads.begin(), loads.end()));
    const double mean = static_cast<double>(triangles) / static_cast<double>(plan.tasks);
    if (wished > 0 || plan.tasks == 1 || longest <= good_balance * mean) return;
    // In steps of a sixteenth: the search takes a moment even for the largest scene.
    plan.tasks -= std::max<std::uint64_t>(1, plan.tasks / 16);
  }
}

std::uint64_t longest_task(const Plan& plan) {
  std::vector<std::uint64_t> loads(plan.tasks);
  for (const std::size_t i : plan.to_build()) loads[plan.shards[i].task] += plan.shards[i].stretch.triangles;
  return loads.empty() ? 0 : *std::max_element(loads.begin(), loads.end());
}

std::string ranges_text(std::span<const std::uint64_t> numbers, std::size_t ranges) {
  std::string text;
  for (std::size_t i = 0, end = 0; i < numbers.size(); i = end, --ranges) {
    if (ranges == 0) return text + ",...";
    for (end = i + 1; end < numbers.size() && numbers[end] == numbers[end - 1] + 1; ++end) {
    }
    text += fmt::format("{}{}", text.empty() ? "" : ",", numbers[i]);
    if (end > i + 1) text += fmt::format("-{}", numbers[end - 1]);
  }
  return text;
}

}  // namespace roam::store
