#pragma once
/// \file
/// DefaultFloatingPoint for work on several threads.

#include <tbb/task_arena.h>

#include "math/floating_point.h"
#include "math/threads.h"

namespace roam {

/// Runs `work` and all TBB tasks that it makes in the default floating-point environment. A task uses the environment
/// of its arena, which is that of the thread that made the arena. The calling thread's implicit arena may have the
/// host's environment, so this function makes another arena, for at most `threads` threads; 0: one a core.
template <class Work>
auto in_default_floating_point(const Work& work, int threads = 0) {
  const DefaultFloatingPoint guard;
  tbb::task_arena arena(threads_for(threads));
  return arena.execute(work);
}

}  // namespace roam
