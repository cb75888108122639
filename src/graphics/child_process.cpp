#include "graphics/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <thread>

#include "roam/error.h"

namespace roam::graphics {
namespace {

/// Above every number that an Inheritance asks for.
constexpr int first_free_descriptor = 16;
constexpr int exec_failed = 127;
/// Milliseconds for a child to end in order.
constexpr int grace = 3000;

/// What the child does between fork and exec: only what is allowed there in a program with threads.
[[noreturn]] void become(const char* program, char* const* argv, const std::vector<Inheritance>& moved, int words,
                         Orphan orphan, pid_t parent) {
  setsid();
  if (orphan == Orphan::dies) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(exec_failed);
  }
  struct sigaction usual = {};
  usual.sa_handler = SIG_DFL;
  for (int s = 1; s < NSIG; ++s) sigaction(s, &usual, nullptr);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);

  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing > 0) dup2(nothing, STDIN_FILENO);
  dup2(words, STDOUT_FILENO);
  dup2(words, STDERR_FILENO);
  for (const Inheritance& i : moved) dup2(i.ours, i.theirs);
  execv(program, argv);
  _exit(exec_failed);
}

}  // namespace

std::filesystem::path find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path program = std::filesystem::path(folder.empty() ? "." : folder) / name;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(program, ignored) && access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

ChildProcess::ChildProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                           const std::vector<Inheritance>& inheritance, Orphan orphan) {
  // Everything is made ready before the fork: afterwards the child must not allocate.
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  words_ = memfd_create("last words", MFD_CLOEXEC);
  // Out of the way of the numbers that are about to be replaced.
  std::vector<Inheritance> moved;
  for (const Inheritance& i : inheritance) {
    moved.push_back({fcntl(i.ours, F_DUPFD_CLOEXEC, first_free_descriptor), i.theirs});
  }
  const int words = fcntl(words_, F_DUPFD_CLOEXEC, first_free_descriptor);

  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) become(program.c_str(), argv.data(), moved, words, orphan, parent);
  const int failure = errno;

  for (const Inheritance& i : moved) close(i.ours);
  close(words);
  if (pid_ < 0) {
    close(words_);
    throw Error("cannot start " + program.string() + ": " + std::strerror(failure));
  }
}

ChildProcess::~ChildProcess() {
  end();
  close(words_);
}

bool ChildProcess::wait(int milliseconds) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(milliseconds);
  while (!collected_) {
    int status = 0;
    const pid_t answer = waitpid(pid_, &status, WNOHANG);
    if (answer == pid_) {
      collected_ = true;
      succeeded_ = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    } else if (answer < 0 && errno != EINTR) {
      collected_ = true;  // by a program that ignores SIGCHLD: how it ended is lost
    } else if (std::chrono::steady_clock::now() >= deadline) {
      return false;
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
  return true;
}

void ChildProcess::end() {
  if (collected_) return;
  // Asked first: Xvfb removes its lock and its socket.
  kill(pid_, SIGTERM);
  if (wait(grace)) return;
  kill(pid_, SIGKILL);
  while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
  collected_ = true;
}

std::string ChildProcess::last_words() const {
  std::array<char, 2048> tail;
  struct stat file = {};
  fstat(words_, &file);
  const off_t from = std::max<off_t>(0, file.st_size - static_cast<off_t>(tail.size()));
  const ssize_t n = pread(words_, tail.data(), tail.size(), from);
  std::istringstream lines(std::string(tail.data(), n > 0 ? static_cast<std::size_t>(n) : 0));
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
  }
  return last;
}

}  // namespace roam::graphics
