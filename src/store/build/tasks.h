#pragma once
/// \file
/// Tasks: the shards of a plan, shared out among the jobs of a batch engine.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "store/build/plan.h"

namespace roam::store {

/// The longest task, divided by the mean, up to which tasks count as balanced.
inline constexpr double good_balance = 1.3;
/// Tasks, at most, if their number is left to roam: batch engines refuse longer arrays by default.
inline constexpr std::uint64_t most_good_tasks = 1000;

/// Shares loads out among tasks, about equally: the task of each load. The same loads give the same tasks.
[[nodiscard]] std::vector<std::uint64_t> share_out(std::span<const std::uint64_t> loads, std::uint64_t tasks);

/// Gives each shard that is to be built to one of `wished` tasks, about equally long, or fewer: no task is empty.
/// 0: as many as are balanced, at most most_good_tasks; at least 1. Sets Plan::tasks and PlannedShard::task. The same
/// plan and wish give the same tasks.
void assign_tasks(Plan& plan, std::uint64_t wished);

/// The triangles of the longest task. 0 if there is none.
[[nodiscard]] std::uint64_t longest_task(const Plan& plan);

/// Ascending numbers as text: "3,7-9". At most `ranges` ranges, then ",...".
[[nodiscard]] std::string ranges_text(std::span<const std::uint64_t> numbers, std::size_t ranges);

}  // namespace roam::store
