// The thread that moves a body in a store makes no system call, except to wake a loading thread: it reads no file,
// waits for nobody, and takes no memory. The kernel ends the process otherwise.

#include <gtest/gtest.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/futex.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <functional>
#include <numbers>

#include "pager_made.h"
#include "roam/generate.h"
#include "roam/walker.h"

namespace {

using roam::Pager;
using roam::Vec3;

/// From now on this thread may only wake others, ask for the time, sleep and end the process.
bool lock_in() {
  constexpr unsigned number = offsetof(seccomp_data, nr), operation = offsetof(seccomp_data, args) + 8;
  const auto let = [](unsigned call) -> std::array<sock_filter, 2> {
    return {{BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, 1), BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)}};
  };
  std::vector<sock_filter> rules{BPF_STMT(BPF_LD | BPF_W | BPF_ABS, number)};
  for (const unsigned call : {SYS_clock_gettime, SYS_clock_nanosleep, SYS_nanosleep, SYS_exit_group}) {
    for (const sock_filter& rule : let(call)) rules.push_back(rule);
  }
  rules.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_futex, 1, 0));
  rules.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS));
  rules.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, operation));
  rules.push_back(BPF_STMT(BPF_ALU | BPF_AND | BPF_K, static_cast<unsigned>(FUTEX_CMD_MASK)));
  for (const sock_filter& rule : let(FUTEX_WAKE)) rules.push_back(rule);
  rules.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS));
  const sock_fprog program{static_cast<unsigned short>(rules.size()), rules.data()};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

constexpr int cannot_be_locked_in = 77;

/// Does the work in a thread that is locked in, in a process of its own, where another thread does `meanwhile` again
/// and again; `judge` returns its exit status afterwards. Returns the wait status.
int locked_in(const std::function<void()>& prepare, const std::function<void()>& work,
              const std::function<void()>& meanwhile, const std::function<int()>& judge) {
  const pid_t child = ::fork();
  if (child == 0) {
    prepare();
    std::atomic<bool> done{false};
    std::thread worker([&] {
      if (!lock_in()) ::_exit(cannot_be_locked_in);
      work();
      done = true;
      while (true) std::this_thread::sleep_for(std::chrono::seconds(1));  // its end would take more calls
    });
    while (!done) {
      meanwhile();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ::_exit(judge());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

// Instrumented programs make calls of their own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

TEST(PagerSystemCalls, AreNoneOfTheBodysThread) {
  const made::Folder folder("pager_system_calls");
  const auto meshes = roam::generate::collect(roam::generate::gallery({.triangles = 1'000'000, .seed = 2}));
  made::store(folder.path(), meshes, {.page_tiles = 16, .tile_triangles = 1000});
  const Vec3 from = roam::generate::gallery_paths[0].from;
  std::optional<Pager> pager;
  std::optional<roam::Walker> walker;
  long moved = 0;
  const int status = locked_in(
      [&] {
        pager.emplace(roam::Store::open(folder.path()), roam::PagerOptions{.memory = Pager::least_memory});
        if (!pager->wait({0.3, 0.6}, from, Vec3(0.0), 30.0)) ::_exit(2);
        walker.emplace(*pager, roam::WalkerSettings{}, roam::Mode::walk, from);
      },
      [&] {
        std::array<roam::Contact, 16> contacts;
        for (int i = 0; i < 2500; ++i) {
          const double angle = 0.82 + 0.1 * ((i / 50) % 5 - 2) + (i % 1000 > 900 ? std::numbers::pi : 0.0);
          const roam::StepReport& step =
              walker->step({.velocity = {30.0 * std::cos(angle), 30.0 * std::sin(angle), 0.0}}, 1.0 / 60.0);
          moved += step.to != step.from ? 1 : 0;
          (void)pager->update(walker->body(), walker->position(), walker->velocity());
          const roam::Query query{walker->body(), walker->position(), {1.0, 2.0, 3.0}};
          (void)pager->sweep(query);
          (void)pager->clearance(query, 1.0);
          (void)pager->gap_bound(query, 1.0);
          (void)pager->contacts(query, 0.5, contacts);
          std::this_thread::sleep_for(std::chrono::microseconds(300));
        }
      },
      // This locks what update() must not wait for, much more often than loading threads do.
      [&] {
        for (int i = 0; i < 30'000; ++i) (void)pager->stats();
      },
      // It is no proof unless the body moved on, and tiles came and went.
      [&] { return moved > 1000 && pager->stats().evictions > 20 && pager->stats().loads > 50 ? 0 : 3; });
  if (WIFEXITED(status) && WEXITSTATUS(status) == cannot_be_locked_in) GTEST_SKIP() << "no seccomp here";
  EXPECT_FALSE(WIFSIGNALED(status)) << "signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(PagerSystemCalls, AreSeen) {
  const auto nothing = [] {};
  const int status = locked_in(
      nothing, [] { (void)::getppid(); }, nothing, [] { return 0; });
  if (WIFEXITED(status) && WEXITSTATUS(status) == cannot_be_locked_in) GTEST_SKIP() << "no seccomp here";
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGSYS) << status;
  EXPECT_EQ(locked_in(nothing, nothing, nothing, [] { return 0; }), 0);
}

#endif

}  // namespace
