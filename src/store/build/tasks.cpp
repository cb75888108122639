#include "store/build/tasks.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

namespace roam::store {

std::vector<std::uint64_t> share_out(std::span<const std::uint64_t> loads, std::uint64_t tasks) {
  std::vector<std::size_t> order(loads.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return loads[a] > loads[b]; });
  // Each load goes to the least loaded task, the largest one first: then the longest task is at most 4/3 of the best
  // possible one (Graham 1969).
  using Load = std::pair<std::uint64_t, std::uint64_t>;  // with the task
  std::priority_queue<Load, std::vector<Load>, std::greater<>> least;
  const std::uint64_t used = std::min<std::uint64_t>(tasks, loads.size());
  for (std::uint64_t t = 0; t < used; ++t) least.push({0, t});
  std::vector<std::uint64_t> task_of(loads.size());
  for (const std::size_t i : order) {
    const auto [load, task] = least.top();
    least.pop();
    task_of[i] = task;
    least.push({load + loads[i], task});
  }
  return task_of;
}

void assign_tasks(Plan& plan, std::uint64_t wished) {
  const std::vector<std::size_t> shards = plan.to_build();
  std::vector<std::uint64_t> loads;
  for (const std::size_t i : shards) loads.push_back(plan.shards[i].stretch.triangles);
  const auto triangles = std::accumulate(loads.begin(), loads.end(), std::uint64_t{0});
  plan.tasks = std::min<std::uint64_t>(wished > 0 ? wished : most_good_tasks, shards.size());
  while (plan.tasks > 0) {
    const std::vector<std::uint64_t> task_of = share_out(loads, plan.tasks);
    for (std::size_t n = 0; n < shards.size(); ++n) plan.shards[shards[n]].task = task_of[n];
    const double mean = static_cast<double>(triangles) / static_cast<double>(plan.tasks);
    if (wished > 0 || plan.tasks == 1 || static_cast<double>(longest_task(plan)) <= good_balance * mean) return;
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
