#include "cli/interrupt.h"

#include <pthread.h>
#include <semaphore.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <exception>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <thread>

#include "cli/tell.h"
#include "files/unfinished.h"
#include "process/child.h"
#include "process/thread_without_signals.h"
#include "roam/error.h"

namespace roam::app {
namespace {

/// Time for children to end in order: Xvfb removes its lock and its socket.
constexpr std::chrono::milliseconds grace_of_children{100};

/// The watchdog ends the program within this time, once that is due.
constexpr std::chrono::nanoseconds patience_with_watchdog = std::chrono::milliseconds(4000);
/// After this time a line says what the program still does.
constexpr std::chrono::milliseconds silent_writing{2000};

std::atomic<int> signal_came = 0;  ///< its number
// Nanoseconds of the steady clock.
std::atomic<std::int64_t> came_at{0};
std::atomic<std::int64_t> given_at{0};
std::atomic<std::int64_t> given = std::chrono::nanoseconds(longest_good_order).count();
sem_t signals;  ///< one for each signal that arrived

/// After a signal: when the watchdog ends the program.
std::int64_t due() { return std::max<std::int64_t>(came_at, given_at) + given; }

extern "C" void take_signal(int number) {
  const int error = errno;
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t moment = std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
  if (signal_came == 0) {
    came_at = moment;
  } else if (moment - due() > patience_with_watchdog.count()) {
    // The next signal gets its default action, in case the watchdog itself hangs.
    std::signal(number, SIG_DFL);
  }
  signal_came = number;
  sem_post(&signals);
  errno = error;
}

void wait_for_signal() {
  while (sem_wait(&signals) != 0 && errno == EINTR) {
  }
}

/// Waits until a signal arrives, at most `longest`. Returns whether one arrived.
bool wait_for_signal(std::chrono::milliseconds longest) {
  timespec until{};
  clock_gettime(CLOCK_MONOTONIC, &until);
  const auto nanoseconds = until.tv_nsec + std::chrono::nanoseconds(longest).count();
  until.tv_sec += nanoseconds / 1'000'000'000;
  until.tv_nsec = nanoseconds % 1'000'000'000;
  int failed = 0;
  do {
    failed = sem_clockwait(&signals, CLOCK_MONOTONIC, &until);
  } while (failed != 0 && errno == EINTR);
  return failed == 0;
}

/// Allocates nothing.
void say(std::string_view words) {
  [[maybe_unused]] const auto told = ::write(STDERR_FILENO, words.data(), words.size());
}

[[noreturn]] void end_at_once(int number) {
  try {
    process::end_children(grace_of_children);
    files::Unfinished::remove_all();
  } catch (const std::exception&) {
    // There is no memory left for cleaning up. The program ends anyway.
  }
  say("roam: cancelled\n");
  std::signal(number, SIG_DFL);
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, number);
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
  std::raise(number);
  _exit(128 + number);
}

/// Waits until a signal arrives that is not the first one sent again, at most `longest`. Returns whether one arrived.
bool wait_for_another_signal(std::chrono::milliseconds longest) {
  const auto until = std::chrono::steady_clock::now() + longest;
  for (;;) {
    const auto now = std::chrono::steady_clock::now();
    if (now >= until) return false;
    if (!wait_for_signal(std::chrono::ceil<std::chrono::milliseconds>(until - now))) return false;
    const auto since_first = std::chrono::steady_clock::now().time_since_epoch() - std::chrono::nanoseconds(came_at);
    if (since_first > longest_repeat) return true;
  }
}

void watch() {
  wait_for_signal();
  for (bool another = false, said = false; !another;) {
    const std::chrono::nanoseconds now = std::chrono::steady_clock::now().time_since_epoch();
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(std::chrono::nanoseconds(due()) - now);
    if (left <= left.zero()) break;
    if (!said && now - std::chrono::nanoseconds(came_at) > longest_good_order + silent_writing) {
      say("roam: still writing the results; Ctrl-C again drops them\n");
      said = true;
    }
    // It may be put off meanwhile.
    constexpr std::chrono::milliseconds look{100};
    another = wait_for_another_signal(std::min(left, look));
  }
  give_time_to_write(std::chrono::milliseconds(0));
  end_at_once(signal_came);
}

}  // namespace

void catch_signals() {
  sem_init(&signals, 0, 0);
  // The watchdog takes no signals, so that they reach other threads and interrupt their waiting.
  process::thread_without_signals(watch).detach();
  struct sigaction action {};
  action.sa_handler = take_signal;
  // No SA_RESTART, so that a read from a terminal returns.
  sigemptyset(&action.sa_mask);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    // A shell that runs a job in the background, or nohup, has set the signal to be ignored.
    if (sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    sigaction(number, &action, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);
  // So that a file that grows beyond `ulimit -f` gives a write error with a message.
  std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupted() { return signal_came != 0; }

int interrupted_status() { return 128 + signal_came; }

void give_time_to_write(std::chrono::milliseconds longest) {
  // In this order, the time that was left is not cut before the new time begins.
  given_at = std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  given = std::chrono::nanoseconds(longest).count();
}

void stop_if_interrupted() {
  if (interrupted()) throw Cancelled();
}

bool has_time() {
  if (!interrupted()) return true;
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return now - std::chrono::nanoseconds(came_at) < longest_good_order / 2;
}

bool finishes(const std::string& otherwise, const std::function<void()>& work) {
  try {
    work();
    return true;
  } catch (const std::runtime_error&) {
    // Ctrl-C also ends the process that reads a scene, which is another error.
    if (!interrupted()) throw;
    tell("note: " + otherwise + ": Ctrl-C came before");
    return false;
  }
}

}  // namespace roam::app
