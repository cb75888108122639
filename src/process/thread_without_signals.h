#pragma once
/// \file
/// Threads that take no signals.

#include <pthread.h>
#include <signal.h>

#include <thread>
#include <utility>

namespace roam::process {

/// A thread that blocks all signals, so that they reach the program's own threads. Throws what std::thread throws.
template <class Run>
[[nodiscard]] std::thread thread_without_signals(Run&& run) {
  // A thread begins with the blocked signals of the one that starts it.
  struct Blocked {
    sigset_t before;
    Blocked() {
      sigset_t all;
      ::sigfillset(&all);
      ::pthread_sigmask(SIG_SETMASK, &all, &before);
    }
    ~Blocked() { ::pthread_sigmask(SIG_SETMASK, &before, nullptr); }
    Blocked(const Blocked&) = delete;
    Blocked& operator=(const Blocked&) = delete;
  };
  const Blocked blocked;
  return std::thread(std::forward<Run>(run));
}

}  // namespace roam::process
