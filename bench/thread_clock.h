#pragma once
/// \file
/// The clock of steps: what other programs do does not count.

#include <time.h>

#include <algorithm>

namespace roam::bench {

/// Nanoseconds that this thread has been running.
[[nodiscard]] inline double thread_time() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

/// What two readings of that clock take, nanoseconds.
[[nodiscard]] inline double cost_of_reading() {
  double least = 1e9;
  for (int i = 0; i < 1000; ++i) {
    const double begin = thread_time();
    least = std::min(least, thread_time() - begin);
  }
  return least;
}

}  // namespace roam::bench
