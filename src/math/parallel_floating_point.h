#pragma once
/// \file
/// DefaultFloatingPoint for work on several threads.

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <optional>
#include <type_traits>
#include <utility>

#include "math/floating_point.h"
#include "math/threads.h"

namespace roam {

/// Runs `work` and all TBB tasks that it makes in the default floating-point environment, on at most `threads` threads;
/// 0: one a core. A task uses the environment of its context, or else of its arena, which is that of the thread that
/// made the arena. The calling thread's implicit arena may have the host's environment, so this function makes a
/// context. Only fewer threads need an arena of their own: oneTBB 2021.8 leaks 7 KB for each.
template <class Work>
auto in_default_floating_point(const Work& work, int threads = 0) {
  const DefaultFloatingPoint guard;
  if (threads > 0) {
    tbb::task_arena arena(threads_for(threads));
    return arena.execute(work);
  }
  // Isolated, twice: a caller's cancelled tasks do not end this work, and the thread that waits takes no others.
  tbb::task_group_context context(tbb::task_group_context::isolated);
  context.capture_fp_settings();
  return tbb::this_task_arena::isolate([&] {
    tbb::task_group group(context);
    using Result = std::invoke_result_t<const Work&>;
    if constexpr (std::is_void_v<Result>) {
      group.run_and_wait(work);
    } else {
      std::optional<Result> result;
      group.run_and_wait([&] { result.emplace(work()); });
      return Result(std::move(*result));
    }
  });
}

}  // namespace roam
