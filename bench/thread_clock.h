#pragma once
/// \file
/// The clock of steps: the thread's own time, without other programs.

#include <time.h>

#include <algorithm>

namespace roam::bench {

/// The thread's running time, nanoseconds.
[[nodiscard]] inline double thread_time() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

/// The time of two readings of that clock, nanoseconds.
[[nodiscard]] inline double cost_of_reading() {
  double least = 1e9;
  for (int i = 0; i < 1000; ++i) {
    const double begin = thread_time();
    least = std::min(least, thread_time() - begin);
  }
  return least;
}

}  // namespace roam::bench
