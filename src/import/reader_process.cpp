#include "import/reader_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <thread>
#include <utility>

#include "import/stream.h"
#include "roam/error.h"

namespace roam::reader {
namespace {

/// As much of the child's last words as a message can use.
constexpr std::size_t complaint_limit = 8192;
/// Asked of the system for the stream, so that the child seldom waits for us; a smaller pipe works too.
[[maybe_unused]] constexpr int pipe_bytes = 1 << 20;

struct Pipe {
  int read_end = -1;
  int write_end = -1;

  Pipe() {
    int ends[2];
#ifdef __linux__
    if (pipe2(ends, O_CLOEXEC) != 0) {
#else
    if (pipe(ends) != 0) {
#endif
      throw Error(std::string("cannot open a pipe to the scene reader: ") + std::strerror(errno));
    }
    read_end = ends[0];
    write_end = ends[1];
#ifndef __linux__
    fcntl(read_end, F_SETFD, FD_CLOEXEC);
    fcntl(write_end, F_SETFD, FD_CLOEXEC);
#endif
  }
  ~Pipe() {
    if (read_end >= 0) close(read_end);
    if (write_end >= 0) close(write_end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int release_read_end() {
    fcntl(read_end, F_SETFL, fcntl(read_end, F_GETFL) | O_NONBLOCK);
    const int end = read_end;
    read_end = -1;
    return end;
  }
};

/// posix_spawn's two settings, freed on every way out.
struct SpawnSettings {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;

  SpawnSettings() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
};

/// The absolute ones of a list of folders. Others would lie wherever the program was started.
std::string absolute_folders(const std::string& list) {
  std::string kept;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(':', begin), list.size());
    const std::string folder = list.substr(begin, end - begin);
    if (folder.starts_with('/')) kept += (kept.empty() ? "" : ":") + folder;
    begin = end + 1;
  }
  return kept;
}

/// "NAME=value" of what a reader needs of this process's environment. Variables also say which libraries and files are
/// opened, so that no other is handed on.
std::vector<std::string> clean_environment() {
  std::vector<std::string> variables{"PATH=/usr/bin:/bin"};
  for (const char* name : {"LD_LIBRARY_PATH", "TMPDIR"}) {
    const char* value = std::getenv(name);
    const std::string folders = value == nullptr ? "" : absolute_folders(value);
    if (!folders.empty()) variables.push_back(std::string(name) + "=" + folders);
  }
  // Where the sanitizers that both are built with are told what to do.
  for (const char* name : {"ASAN_OPTIONS", "UBSAN_OPTIONS", "TSAN_OPTIONS", "LSAN_OPTIONS"}) {
    if (const char* value = std::getenv(name)) variables.push_back(std::string(name) + "=" + value);
  }
  return variables;
}

std::vector<char*> pointers_to(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

/// Two ends that are told, and do not kill, when the other is gone.
struct SocketPair {
  int ours = -1, theirs = -1;

  explicit SocketPair(bool wanted) {
    if (!wanted) return;
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
      throw Error(std::string("cannot open a pipe to the scene reader: ") + std::strerror(errno));
    }
    ours = ends[0];
    // An end numbered 0 to 3 would be overwritten by the others.
    theirs = fcntl(ends[1], F_DUPFD_CLOEXEC, stream_fd + 1);
    const int error = errno;
    close(ends[1]);
    if (theirs < 0) {
      close(ours);
      throw Error(std::string("cannot open a pipe to the scene reader: ") + std::strerror(error));
    }
  }
  ~SocketPair() {
    if (ours >= 0) close(ours);
    if (theirs >= 0) close(theirs);
  }
  SocketPair(const SocketPair&) = delete;
  SocketPair& operator=(const SocketPair&) = delete;
};

/// A descriptor above those that the child's own standard descriptors and stream replace.
int moved_out_of_the_way(int descriptor) {
  const int moved = fcntl(descriptor, F_DUPFD_CLOEXEC, stream_fd + 1);
  if (moved < 0) throw Error(std::string("cannot open a pipe to the scene reader: ") + std::strerror(errno));
  return moved;
}

}  // namespace

ReaderProcess::ReaderProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                             bool takes_requests) {
  Pipe stream, complaints;
  SocketPair requests(takes_requests);
  // dup2 onto itself would leave close-on-exec set, and an end numbered 1 or 2 would be overwritten by the other's.
  for (Pipe* pipe : {&stream, &complaints}) {
    const int moved = moved_out_of_the_way(pipe->write_end);
    close(pipe->write_end);
    pipe->write_end = moved;
  }
#ifdef F_SETPIPE_SZ
  fcntl(stream.read_end, F_SETPIPE_SZ, pipe_bytes);
#endif

  SpawnSettings settings;
  if (takes_requests) {
    posix_spawn_file_actions_adddup2(&settings.files, requests.theirs, STDIN_FILENO);
  } else {
    posix_spawn_file_actions_addopen(&settings.files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  }
  posix_spawn_file_actions_adddup2(&settings.files, complaints.write_end, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&settings.files, complaints.write_end, STDERR_FILENO);
  posix_spawn_file_actions_adddup2(&settings.files, stream.write_end, stream_fd);

  // The host program may ignore or block signals; the child must die of them.
  sigset_t all, none;
  sigfillset(&all);
  sigemptyset(&none);
  posix_spawnattr_setsigdefault(&settings.attributes, &all);
  posix_spawnattr_setsigmask(&settings.attributes, &none);
  posix_spawnattr_setflags(&settings.attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);

#if defined(__GLIBC__) || defined(__APPLE__)
  posix_spawn_file_actions_addchdir_np(&settings.files, "/");
#endif

  const std::string name = std::filesystem::absolute(program).string();
  std::vector<std::string> command{name};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const std::vector<std::string> environment = clean_environment();
  pid_t pid = -1;
  const int failure = posix_spawn(&pid, name.c_str(), &settings.files, &settings.attributes,
                                  pointers_to(command).data(), pointers_to(environment).data());
  if (failure != 0) {
    throw Error("cannot run the scene reader " + name + ": " + std::strerror(failure) +
                ". Install roam anew, or name the program by the environment variable ROAM_READER.");
  }
  pid_ = pid;
  requests_ = std::exchange(requests.ours, -1);
  stream_ = stream.release_read_end();
  complaint_pipe_ = complaints.release_read_end();
}

ReaderProcess::~ReaderProcess() {
  try {
    finish(0);
  } catch (const std::exception&) {
    // It is killed and collected; its last words did not fit the memory.
  }
  if (requests_ >= 0) close(requests_);
  close(stream_);
  if (complaint_pipe_ >= 0) close(complaint_pipe_);
}

void ReaderProcess::request(std::string_view bytes) {
  const auto length = static_cast<std::uint32_t>(bytes.size());
  std::string message(reinterpret_cast<const char*>(&length), sizeof(length));
  message += bytes;
  // One that does not take so little at once is not waiting for it.
  const ssize_t n = send(requests_, message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  if (n != static_cast<ssize_t>(message.size())) {
    throw Error(std::string("the scene reader takes no request: ") + std::strerror(n < 0 ? errno : EAGAIN));
  }
}

bool ReaderProcess::has_ended() const {
  pollfd stream{stream_, POLLIN, 0};
  return poll(&stream, 1, 0) > 0 && (stream.revents & POLLIN) == 0;
}

ReaderProcess::Arrival ReaderProcess::receive(std::span<std::byte> buffer, int milliseconds, std::size_t& received) {
  received = 0;
  std::array<pollfd, 2> wait{{{stream_, POLLIN, 0}, {complaint_pipe_, POLLIN, 0}}};
  if (poll(wait.data(), wait.size(), milliseconds) < 0 && errno != EINTR) {
    throw Error(std::string("cannot wait for the scene reader: ") + std::strerror(errno));
  }
  drain_complaints();
  const ssize_t n = read(stream_, buffer.data(), buffer.size());
  if (n > 0) {
    received = static_cast<std::size_t>(n);
    return Arrival::bytes;
  }
  if (n == 0) return Arrival::end;
  if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) return Arrival::nothing;
  throw Error(std::string("cannot read from the scene reader: ") + std::strerror(errno));
}

void ReaderProcess::drain_complaints() {
  std::array<char, 4096> chunk;
  // Bounded, so that a child that never stops complaining does not keep us from its stream.
  for (int i = 0; i < 16; ++i) {
    const ssize_t n = read(complaint_pipe_, chunk.data(), chunk.size());
    if (n == 0) {
      // It has closed both; a closed pipe would wake whoever waits again and again.
      close(complaint_pipe_);
      complaint_pipe_ = -1;
    }
    if (n <= 0) return;
    complaints_.append(chunk.data(), static_cast<std::size_t>(n));
    if (complaints_.size() > complaint_limit) complaints_.erase(0, complaints_.size() - complaint_limit);
  }
}

Ending ReaderProcess::finish(int milliseconds) {
  if (pid_ < 0) return {};
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::milliseconds(milliseconds);
  int status = 0;
  pid_t collected = 0;
  while ((collected = waitpid(pid_, &status, WNOHANG)) == 0 && Clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const bool killed_here = collected == 0;
  if (killed_here) {
    kill(pid_, SIGKILL);
    do {
      collected = waitpid(pid_, &status, 0);
    } while (collected < 0 && errno == EINTR);
  }
  pid_ = -1;
  drain_complaints();
  if (collected < 0 || killed_here) return {};
  Ending ending;
  ending.known = true;
  if (WIFSIGNALED(status)) ending.signal = WTERMSIG(status);
  if (WIFEXITED(status)) ending.exit_code = WEXITSTATUS(status);
  return ending;
}

}  // namespace roam::reader
