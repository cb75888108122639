#pragma once
/// \file
/// DefaultFloatingPoint for work on several threads.

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "math/floating_point.h"

namespace roam {

/// The most threads that the calling thread's tasks may use.
[[nodiscard]] inline int available_threads() {
  const auto limit = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return std::min(tbb::this_task_arena::max_concurrency(), static_cast<int>(limit));
}

/// Runs `work` and all TBB tasks that it makes in the default floating-point environment. A task uses the environment
/// of its arena, which is that of the thread that made the arena. The calling thread's implicit arena may have the
/// host's environment, so this function makes another arena, for at most `threads` threads; 0: one a core.
template <class Work>
auto in_default_floating_point(const Work& work, int threads = 0) {
  const DefaultFloatingPoint guard;
  const int most = available_threads();
  tbb::task_arena arena(threads > 0 ? std::min(threads, most) : most);
  return arena.execute(work);
}

}  // namespace roam
