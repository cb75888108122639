#include "process/spawn.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <mutex>
#include <thread>

#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "process/thread_without_signals.h"

namespace roam::process {
namespace {

constexpr int exec_failed = 127;

/// In the child: runs the program, or returns on failure.
void become(const Plan& plan, [[maybe_unused]] pid_t parent) {
  // All signals stay blocked until every handler of the parent is replaced.
  struct sigaction usual = {};
  usual.sa_handler = SIG_DFL;
  for (int s = 1; s < NSIG; ++s) ::sigaction(s, &usual, nullptr);
  if (plan.own_session) ::setsid();
#ifdef __linux__
  if (plan.dies_with_parent) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(exec_failed);
  }
#endif
  if (plan.folder != nullptr && ::chdir(plan.folder) != 0) return;
  for (const Inheritance& i : plan.descriptors) {
    if (::dup2(i.ours, i.theirs) < 0) return;
  }
  sigset_t none;
  sigemptyset(&none);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
  ::execve(plan.program, plan.arguments, plan.environment);
}

/// Uses vfork: the child shares this process's memory while this thread waits, so no page of a large process is copied.
[[gnu::noinline]] pid_t start(const Plan& plan) {
  static volatile int failure;  // shared by the one thread that starts children and by the child
  static pid_t parent;
  failure = 0;
  parent = ::getpid();
  const pid_t child = ::vfork();
  if (child == 0) {
    become(plan, parent);
    failure = errno;
    ::_exit(exec_failed);
  }
  if (child < 0) return -errno;
  if (failure == 0) return child;
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return -failure;
}

int niceness() {
#ifdef __linux__
  return ::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()));
#else
  return 0;
#endif
}

/// The thread that starts children. It never ends and is never destroyed.
class Spawner {
 public:
  Spawner() : process_(::getpid()) {
    thread_without_signals([this] { run(); }).detach();
  }

  /// The spawner of this process. A forked process has none of its parent's threads and makes its own.
  static Spawner& ours() {
    static std::atomic<Spawner*> current{nullptr};
    Spawner* found = current;
    while (found == nullptr || found->process_ != ::getpid()) {
      auto* made = new Spawner;
      if (current.compare_exchange_strong(found, made)) return *made;
      // Another thread was quicker. The new thread waits for work for ever.
    }
    return *found;
  }

  pid_t spawn(const Plan& plan) {
    const std::lock_guard turn(turn_);
    std::unique_lock lock(mutex_);
    nice_ = niceness();
    plan_ = &plan;
    changed_.notify_all();
    changed_.wait(lock, [&] { return plan_ == nullptr; });
    return child_;
  }

 private:
  [[noreturn]] void run() {
    const int own = niceness();
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [&] { return plan_ != nullptr; });
      child_ = start(*plan_);
      if (child_ > 0 && nice_ > own) (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(child_), nice_);
      plan_ = nullptr;
      changed_.notify_all();
    }
  }

  const pid_t process_;
  std::mutex turn_, mutex_;
  std::condition_variable changed_;
  const Plan* plan_ = nullptr;
  int nice_ = 0;
  pid_t child_ = -1;
};

}  // namespace

pid_t spawn(const Plan& plan) { return Spawner::ours().spawn(plan); }

}  // namespace roam::process
