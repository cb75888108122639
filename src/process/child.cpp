#include "process/child.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <map>
#include <mutex>
#include <sstream>
#include <thread>
#include <utility>

#include "roam/error.h"

extern char** environ;

namespace roam::process {
namespace {

using Clock = std::chrono::steady_clock;
using files::Descriptor;

/// Greater than every descriptor number in a child.
constexpr int first_free_descriptor = 16;

/// Children that run, or have ended and are not collected. The system gives their process numbers to no other process.
struct Registry {
  std::mutex mutex;
  std::map<pid_t, pid_t> children;  ///< child to parent; a forked process inherits a copy of this registry
};

/// Never destroyed, because threads may outlive static objects.
Registry& registry() {
  static Registry& it = *new Registry;
  return it;
}

std::vector<char*> pointers_to(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

/// A file in memory. The system frees it with its last descriptor.
Descriptor file_in_memory() {
#ifdef __linux__
  return Descriptor(::memfd_create("last words", MFD_CLOEXEC));
#else
  return Descriptor(::open("/dev/null", O_RDWR | O_CLOEXEC));
#endif
}

/// Whether a child is gone, or has ended and is still to be collected.
bool has_ended(pid_t child) {
  siginfo_t found{};
  return ::waitid(P_PID, static_cast<id_t>(child), &found, WEXITED | WNOHANG | WNOWAIT) != 0 || found.si_pid == child;
}

}  // namespace

Child::Child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
             const ChildSettings& settings) {
  const auto refuse = [&](int error) {
    throw Error::at(program.string(), "cannot start " + program.string() + ": " + std::strerror(error));
  };
  std::vector<std::string> command{program.string()};
  command.insert(command.end(), arguments.begin(), arguments.end());

  words_ = file_in_memory();
  if (!words_.is_open()) refuse(errno);
  const Descriptor nothing(files::again([] { return ::open("/dev/null", O_RDONLY | O_CLOEXEC); }));
  if (!nothing.is_open()) refuse(errno);
  std::vector<Inheritance> wanted{
      {nothing.number(), STDIN_FILENO}, {words_.number(), STDOUT_FILENO}, {words_.number(), STDERR_FILENO}};
  for (const Inheritance& i : settings.descriptors) {
    std::erase_if(wanted, [&](const Inheritance& other) { return other.theirs == i.theirs; });
    wanted.push_back(i);
  }
  // Moves them above the numbers that are about to be replaced.
  std::vector<Descriptor> moved;
  moved.reserve(wanted.size());
  for (Inheritance& i : wanted) {
    moved.emplace_back(::fcntl(i.ours, F_DUPFD_CLOEXEC, first_free_descriptor));
    if (!moved.back().is_open()) refuse(errno);
    i.ours = moved.back().number();
  }

  Plan plan;
  plan.program = command.front().c_str();
  const std::vector<char*> argv = pointers_to(command);
  plan.arguments = argv.data();
  std::vector<char*> environment;
  if (settings.environment) environment = pointers_to(*settings.environment);
  plan.environment = settings.environment ? environment.data() : environ;
  plan.folder = settings.folder.empty() ? nullptr : settings.folder.c_str();
  plan.descriptors = wanted;
  plan.own_session = settings.own_session;
  plan.dies_with_parent = settings.orphan == Orphan::dies;
  Registry& all = registry();
  // Locked before the start, so that end_children() also ends this child.
  const std::lock_guard lock(all.mutex);
  // Made first: if memory runs out, no child has started.
  std::map<pid_t, pid_t> entry{{0, ::getpid()}};
  const pid_t child = spawn(plan);
  if (child < 0) refuse(-child);
  pid_ = child;
  auto node = entry.extract(0);
  node.key() = child;
  all.children.erase(child);  // of a parent that this process was forked from
  all.children.insert(std::move(node));
}

Child::~Child() { end(); }

bool Child::collect() {
  if (pid_ < 0) return true;
  Registry& all = registry();
  const std::lock_guard lock(all.mutex);
  int status = 0;
  const pid_t answer = ::waitpid(pid_, &status, WNOHANG);
  if (answer == 0 || (answer < 0 && errno == EINTR)) return false;
  if (answer == pid_) {
    ending_.known = true;
    if (WIFSIGNALED(status)) ending_.signal = WTERMSIG(status);
    if (WIFEXITED(status)) ending_.exit_code = WEXITSTATUS(status);
  }
  all.children.erase(pid_);
  pid_ = -1;
  return true;
}

bool Child::wait(std::chrono::milliseconds longest) {
  const auto deadline = Clock::now() + longest;
  while (!collect()) {
    if (Clock::now() >= deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

void Child::signal(int number) const {
  const std::lock_guard lock(registry().mutex);
  ::kill(pid_, number);
}

void Child::end(std::chrono::milliseconds grace) {
  if (collect()) return;
  if (grace.count() > 0) {
    signal(SIGTERM);
    if (wait(grace)) return;
  }
  signal(SIGKILL);
  // SIGKILL ends it soon, unless it waits for a disk.
  while (!wait(std::chrono::hours(1))) {
  }
  ending_ = {};
}

std::string Child::last_words() const {
  std::array<char, 2048> tail;
  struct stat file = {};
  ::fstat(words_.number(), &file);
  const off_t from = std::max<off_t>(0, file.st_size - static_cast<off_t>(tail.size()));
  const ssize_t n = ::pread(words_.number(), tail.data(), tail.size(), from);
  std::istringstream lines(std::string(tail.data(), n > 0 ? static_cast<std::size_t>(n) : 0));
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
  }
  return last;
}

void end_children(std::chrono::milliseconds grace) {
  Registry& all = registry();
  const auto send = [&](int number) {
    const std::lock_guard lock(all.mutex);
    for (const auto& [child, parent] : all.children) {
      if (parent == ::getpid()) ::kill(child, number);
    }
  };
  const auto run = [&] {
    const std::lock_guard lock(all.mutex);
    return std::any_of(all.children.begin(), all.children.end(), [](const auto& one) { return !has_ended(one.first); });
  };
  send(SIGTERM);
  const auto until = Clock::now() + grace;
  while (run() && Clock::now() < until) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  send(SIGKILL);
}

}  // namespace roam::process
