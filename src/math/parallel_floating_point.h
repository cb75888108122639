#pragma once
/// \file
/// DefaultFloatingPoint for what runs on several threads.

#include <tbb/task_arena.h>

#include "math/floating_point.h"

namespace roam {

/// Runs `work` in the default floating-point environment, it and all tasks of TBB that it makes. A task has the
/// environment of its arena, which is that of the thread that made the arena: the one that a thread gets by itself may
/// have the host's, so this makes another.
template <class Work>
auto in_default_floating_point(const Work& work) {
  const DefaultFloatingPoint guard;
  tbb::task_arena arena;
  return arena.execute(work);
}

}  // namespace roam
