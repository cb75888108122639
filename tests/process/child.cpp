// Children: what they inherit, how they end, and that none is left behind.
#include "process/child.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <string>
#include <thread>

#include "files/descriptor.h"
#include "process/find_program.h"
#include "process/lines.h"
#include "program.h"
#include "roam/error.h"

namespace roam::process {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

/// A script of the shell as a child.
class Script : public Child {
 public:
  explicit Script(const std::string& commands, const ChildSettings& settings = {})
      : Child("/bin/sh", {"-c", commands}, settings) {}
};

/// The text that a script writes to its descriptor 3.
std::string said(const std::string& commands, ChildSettings settings = {}) {
  std::array<int, 2> ends{};
  EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  settings.descriptors.push_back({ends[1], 3});
  Script child(commands, settings);
  ::close(ends[1]);
  std::string text;
  std::array<char, 4096> piece{};
  for (ssize_t n = 0; (n = ::read(ends[0], piece.data(), piece.size())) > 0;) {
    text.append(piece.data(), static_cast<std::size_t>(n));
  }
  ::close(ends[0]);
  EXPECT_TRUE(child.wait(10s));
  return text;
}

bool is_gone(pid_t process) { return ::kill(process, 0) != 0 && errno == ESRCH; }

/// Waits for a process that is no child of this one.
bool goes_away(pid_t process) {
  for (int i = 0; i < 1000 && !is_gone(process); ++i) std::this_thread::sleep_for(10ms);
  return is_gone(process);
}

TEST(Child, SaysHowItEnded) {
  Script good("exit 0"), bad("exit 5"), killed("kill -SEGV $$");
  ASSERT_TRUE(good.wait(10s) && bad.wait(10s) && killed.wait(10s));
  EXPECT_TRUE(good.ending().is_success());
  EXPECT_EQ(good.id(), -1);
  EXPECT_TRUE(bad.ending().known && !bad.ending().is_success());
  EXPECT_EQ(bad.ending().exit_code, 5);
  EXPECT_EQ(killed.ending().signal, SIGSEGV);
  EXPECT_FALSE(killed.ending().is_success());
}

TEST(Child, SaysWhyAProgramCannotBeStarted) {
  const TestFolder folder;
  const auto complaint = [](const std::string& program) {
    try {
      Child(program, {}, {});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint(folder.file("absent")), "cannot start " + folder.file("absent") + ": No such file or directory");
  EXPECT_EQ(complaint(folder.write("text", "text")), "cannot start " + folder.file("text") + ": Permission denied");
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

TEST(Child, SaysThatTooManyFilesAreOpen) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const int next = ::fcntl(STDOUT_FILENO, F_DUPFD, 20);
  ::close(next);
  std::vector<files::Descriptor> below;
  while (below.empty() || below.back().number() < next - 1) below.emplace_back(::dup(STDOUT_FILENO));
  std::vector<std::string> said;
  for (const int more : {0, 1, 2}) {
    const rlimit few{static_cast<rlim_t>(next + more), before.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &few);
    try {
      Child child("/bin/true", {}, {});
    } catch (const roam::Error& error) {
      said.emplace_back(error.what());
    }
  }
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  ASSERT_EQ(said.size(), 3U);
  for (const std::string& one : said) EXPECT_NE(one.find(std::strerror(EMFILE)), std::string::npos) << one;
}

TEST(Child, KeepsItsLastWords) {
  Script child("echo first; echo; echo last >&2; echo '  '");
  ASSERT_TRUE(child.wait(10s));
  EXPECT_EQ(child.last_words(), "last");
}

TEST(Child, WritesLines) {
  Lines lines;
  Script child("echo first; printf 'sec'; sleep 0.1; printf 'ond\\n\\n'; read go; printf 'rest'",
               {.descriptors = {{lines.theirs(), STDOUT_FILENO}}});
  lines.child_has_started();
  EXPECT_EQ(lines.next(10s), "first");
  EXPECT_EQ(lines.next(10s), "second");
  EXPECT_EQ(lines.next(10s), "");
  EXPECT_EQ(lines.next(10s), std::nullopt) << "a text without a line end";
  EXPECT_TRUE(lines.ended());
}

TEST(Child, WritesNoLineForAWhile) {
  Lines lines;
  Script child("sleep 100", {.descriptors = {{lines.theirs(), STDOUT_FILENO}}});
  lines.child_has_started();
  EXPECT_EQ(lines.next(1ms), std::nullopt);
  EXPECT_FALSE(lines.ended());
}

TEST(Child, HasTheDescriptorsThatItIsGivenAndNoOthers) {
  const int other = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 100);
  EXPECT_EQ(said("test -e /proc/$$/fd/" + std::to_string(other) + " && echo inherited >&3"), "");
  EXPECT_EQ(said("ls -l /proc/$$/fd | grep -c 'last words' >&3"), "2\n") << "its output and its errors";
  EXPECT_EQ(said("readlink /proc/$$/fd/0 >&3"), "/dev/null\n");
  ::close(other);
}

TEST(Child, HasTheEnvironmentAndTheFolderThatItIsGiven) {
  ASSERT_EQ(::setenv("ROAM_TEST_WORD", "inherited", 1), 0);
  EXPECT_EQ(said("echo $ROAM_TEST_WORD >&3"), "inherited\n");
  EXPECT_EQ(said("echo $ROAM_TEST_WORD $OTHER >&3", {.environment = std::vector<std::string>{"OTHER=given"}}),
            "given\n");
  EXPECT_EQ(said("pwd >&3", {.folder = "/"}), "/\n");
  EXPECT_EQ(said("pwd -P >&3"), std::filesystem::current_path().string() + "\n");
}

TEST(Child, DiesOfSignalsThatTheProgramBlocksOrIgnores) {
  const auto before = std::signal(SIGUSR1, SIG_IGN);
  sigset_t set, old;
  sigemptyset(&set);
  sigaddset(&set, SIGUSR1);
  ASSERT_EQ(::pthread_sigmask(SIG_BLOCK, &set, &old), 0);
  Script child("kill -USR1 $$; exit 0");
  EXPECT_TRUE(child.wait(10s));
  EXPECT_EQ(child.ending().signal, SIGUSR1);
  ASSERT_EQ(::pthread_sigmask(SIG_SETMASK, &old, nullptr), 0);
  std::signal(SIGUSR1, before);
}

TEST(Child, IsAskedToEndAndThenKilled) {
  const TestFolder folder;
  {
    Script polite("trap 'echo asked > " + folder.file("polite") + "; exit 0' TERM; echo > " + folder.file("ready") +
                  "; while :; do sleep 0.01; done");
    while (!std::filesystem::exists(folder.file("ready"))) std::this_thread::sleep_for(1ms);
    const auto start = Clock::now();
    polite.end(60s);
    EXPECT_LT(Clock::now() - start, 30s);
  }
  EXPECT_EQ(folder.read("polite"), "asked\n");
  Script stubborn("trap '' TERM; echo > " + folder.file("stubborn") + "; while :; do sleep 0.01; done");
  while (!std::filesystem::exists(folder.file("stubborn"))) std::this_thread::sleep_for(1ms);
  const pid_t process = stubborn.id();
  const auto start = Clock::now();
  stubborn.end(200ms);
  EXPECT_GE(Clock::now() - start, 200ms);
  EXPECT_TRUE(is_gone(process));
  EXPECT_FALSE(stubborn.ending().known);
}

TEST(Child, IsOnlyWaitedForAsLongAsSaid) {
  Script child("exec sleep 600");
  EXPECT_FALSE(child.wait(50ms));
  EXPECT_GT(child.id(), 0);
  const auto start = Clock::now();
  child.end(0ms);
  EXPECT_LT(Clock::now() - start, 30s);
}

TEST(Child, IsCollectedWhereTheProgramIgnoresItsChildren) {
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  Script child("exit 3");
  EXPECT_TRUE(child.wait(10s));
  EXPECT_FALSE(child.ending().known);
  std::signal(SIGCHLD, before);
}

TEST(Child, OutlivesTheThreadThatStartedIt) {
  std::optional<Script> child;
  std::thread([&] { child.emplace("exec sleep 600"); }).join();
  // A signal that a thread's end sends is there at once.
  EXPECT_FALSE(child->wait(300ms));
  EXPECT_GT(child->id(), 0);
}

TEST(Child, DiesWithTheProcessUnlessItIsToLiveOn) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  const pid_t host = ::fork();
  if (host == 0) {
    Script dies("exec sleep 600"), lives("exec sleep 600", {.orphan = Orphan::lives_on});
    const std::array<pid_t, 2> numbers{dies.id(), lives.id()};
    static_cast<void>(!::write(ends[1], numbers.data(), sizeof numbers));
    ::kill(::getpid(), SIGKILL);
  }
  std::array<pid_t, 2> numbers{};
  ASSERT_EQ(::read(ends[0], numbers.data(), sizeof numbers), static_cast<ssize_t>(sizeof numbers));
  ASSERT_EQ(::waitpid(host, nullptr, 0), host);
  EXPECT_TRUE(goes_away(numbers[0]));
  EXPECT_FALSE(is_gone(numbers[1]));
  ::kill(numbers[1], SIGKILL);
  for (const int end : ends) ::close(end);
}

TEST(Child, IsStartedInAProcessThatWasForked) {
  ASSERT_EQ(said("echo here >&3"), "here\n");
  const pid_t forked = ::fork();
  if (forked == 0) ::_exit(said("echo there >&3") == "there\n" ? 0 : 1);
  int status = 0;
  ASSERT_EQ(::waitpid(forked, &status, 0), forked);
  EXPECT_EQ(status, 0);
}

TEST(Child, IsAsNiceAsTheThreadThatStartsIt) {
  std::string nice;
  std::thread([&] {
    ASSERT_EQ(::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), 7), 0);
    nice = said("sleep 0.2; nice >&3");
  }).join();
  EXPECT_EQ(nice, "7\n");
}

TEST(Child, ManyThreadsStartTheirOwn) {
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([i] {
      const std::string word = std::to_string(i);
      for (int k = 0; k < 5; ++k) EXPECT_EQ(said("echo " + word + " >&3"), word + "\n");
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST(EndChildren, EndsThoseThatWereStartedHereAndNoOthers) {
  // A shell may have started one before it became this program.
  const pid_t foreign = ::fork();
  if (foreign == 0) {
    ::execlp("sleep", "sleep", "600", nullptr);
    ::_exit(1);
  }
  Script polite("exec sleep 600"), stubborn("trap '' TERM; while :; do sleep 0.01; done");
  std::this_thread::sleep_for(50ms);
  end_children(100ms);
  EXPECT_TRUE(polite.wait(10s));
  EXPECT_EQ(polite.ending().signal, SIGTERM);
  EXPECT_TRUE(stubborn.wait(10s));
  EXPECT_EQ(::waitpid(foreign, nullptr, WNOHANG), 0) << "it runs on";
  ::kill(foreign, SIGKILL);
  EXPECT_EQ(::waitpid(foreign, nullptr, 0), foreign);
}

TEST(EndChildren, LeavesAloneWhatTheParentOfAForkedProcessStarted) {
  Script child("exec sleep 600");
  const pid_t forked = ::fork();
  if (forked == 0) {
    end_children(0ms);
    ::_exit(0);
  }
  ASSERT_EQ(::waitpid(forked, nullptr, 0), forked);
  EXPECT_FALSE(child.wait(100ms));
}

TEST(FindProgram, LooksInTheFoldersOfPath) {
  const TestFolder folder;
  const std::string program = folder.write("roam-test-program", "#!/bin/sh\n");
  EXPECT_FALSE(can_run(program));
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  EXPECT_TRUE(can_run(program));
  EXPECT_FALSE(can_run(folder.file("")));
  const std::string path = std::getenv("PATH");
  EXPECT_EQ(find_program("roam-test-program"), "");
  ::setenv("PATH", (path + ":" + folder.file("")).c_str(), 1);
  EXPECT_TRUE(std::filesystem::equivalent(find_program("roam-test-program"), program));
  ::setenv("PATH", path.c_str(), 1);
}

TEST(FindProgram, LooksInNoFolderThatDependsOnWhereItWasStarted) {
  const TestFolder folder;
  const std::string program = folder.write("roam-test-program", "#!/bin/sh\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const std::string path = std::getenv("PATH");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.file(""));
  for (const std::string& relative :
       {std::string(), std::string("."),
        std::string("../" + std::filesystem::path(folder.file("")).parent_path().filename().string())}) {
    ::setenv("PATH", (relative + ":" + path).c_str(), 1);
    EXPECT_EQ(find_program("roam-test-program"), "") << relative;
  }
  ::setenv("PATH", path.c_str(), 1);
  std::filesystem::current_path(before);
}

}  // namespace
}  // namespace roam::process
