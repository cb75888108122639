#pragma once
/// \file
/// Numbers of threads.

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace roam {

/// The most threads that the calling thread's tasks may use.
[[nodiscard]] inline int available_threads() {
  const auto limit = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return std::min(tbb::this_task_arena::max_concurrency(), static_cast<int>(limit));
}

/// The threads for an option: as many as `wished`, but at most the available ones; 0: all of these.
[[nodiscard]] inline int threads_for(int wished) {
  return wished > 0 ? std::min(wished, available_threads()) : available_threads();
}

}  // namespace roam
