#include "import/reader_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "import/stream.h"
#include "roam/error.h"

namespace roam::reader {
namespace {

/// Bytes of the child's last output that a message can use.
constexpr std::size_t complaint_limit = 8192;
/// The remedy if neither the file nor the user is the cause.
constexpr const char* try_again = "; open the scene again, with more memory free";
/// Requested size of the stream's pipe, so that the child seldom waits. A smaller pipe works too.
[[maybe_unused]] constexpr int pipe_bytes = 1 << 20;

using files::Descriptor;

[[noreturn]] void refuse_pipe() {
  throw Error(std::string("cannot open a pipe to the scene reader: ") + std::strerror(errno) +
              "; close files or other programs, or raise the limit (ulimit -n)");
}

struct Ends {
  Descriptor ours, theirs;
};

/// A pipe whose reading end never blocks.
Ends open_pipe() {
  int ends[2];
#ifdef __linux__
  if (pipe2(ends, O_CLOEXEC) != 0) refuse_pipe();
#else
  if (pipe(ends) != 0) refuse_pipe();
  for (const int end : ends) fcntl(end, F_SETFD, FD_CLOEXEC);
#endif
  fcntl(ends[0], F_SETFL, fcntl(ends[0], F_GETFL) | O_NONBLOCK);
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

/// A pair of sockets. Writing to one whose other end is closed gives an error, not a signal.
Ends open_sockets() {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) refuse_pipe();
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

/// The absolute folders of a list. Relative ones would depend on the current folder.
std::string absolute_folders(const std::string& list) {
  std::string kept;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(':', begin), list.size());
    const std::string folder = list.substr(begin, end - begin);
    if (folder.starts_with('/')) kept.append(kept.empty() ? "" : ":").append(folder);
    begin = end + 1;
  }
  return kept;
}

/// The environment of a reader, as "NAME=value": only what it needs of this process's. Other variables could make it
/// open other libraries and files.
std::vector<std::string> clean_environment() {
  std::vector<std::string> variables{"PATH=/usr/bin:/bin"};
  const auto value_of = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string(value == nullptr ? "" : value);
  };
  if (const std::string libraries = absolute_folders(value_of("LD_LIBRARY_PATH")); !libraries.empty()) {
    variables.push_back("LD_LIBRARY_PATH=" + libraries);
  }
  // A single folder; a colon may be part of its name.
  if (const std::string folder = value_of("TMPDIR"); folder.starts_with('/')) variables.push_back("TMPDIR=" + folder);
  // Options of the sanitizers that both processes may be built with.
  for (const char* name : {"ASAN_OPTIONS", "UBSAN_OPTIONS", "TSAN_OPTIONS", "LSAN_OPTIONS"}) {
    if (const char* value = std::getenv(name)) variables.push_back(std::string(name) + "=" + value);
  }
  return variables;
}

}  // namespace

ReaderProcess::ReaderProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                             bool takes_requests) {
  Ends stream = open_pipe(), complaints = open_pipe(), requests;
#ifdef F_SETPIPE_SZ
  fcntl(stream.ours.number(), F_SETPIPE_SZ, pipe_bytes);
#endif
  process::ChildSettings settings{.descriptors = {{complaints.theirs.number(), STDOUT_FILENO},
                                                  {complaints.theirs.number(), STDERR_FILENO},
                                                  {stream.theirs.number(), stream_fd}},
                                  .environment = clean_environment(),
                                  .folder = "/",
                                  .own_session = false};
  if (takes_requests) {
    requests = open_sockets();
    settings.descriptors.push_back({requests.theirs.number(), STDIN_FILENO});
  }
  try {
    child_.emplace(std::filesystem::absolute(program), arguments, settings);
  } catch (const Error& error) {
    throw Error::at(error.where(),
                    std::string(error.what()) +
                        ". Install roam anew, or name the program by the environment variable ROAM_READER.");
  }
  requests_ = std::move(requests.ours);
  stream_ = std::move(stream.ours);
  complaint_pipe_ = std::move(complaints.ours);
}

ReaderProcess::~ReaderProcess() { child_->end(std::chrono::milliseconds(0)); }

void ReaderProcess::request(std::string_view bytes) {
  const auto length = static_cast<std::uint32_t>(bytes.size());
  std::string message(reinterpret_cast<const char*>(&length), sizeof(length));
  message += bytes;
  // A reader that does not accept so few bytes at once is not waiting for a request.
  const ssize_t n = send(requests_.number(), message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  if (n != static_cast<ssize_t>(message.size())) {
    throw Error(std::string("the scene reader takes no request: ") + std::strerror(n < 0 ? errno : EAGAIN) +
                "; open the scene again");
  }
}

bool ReaderProcess::has_ended() const {
  pollfd stream{stream_.number(), POLLIN, 0};
  return poll(&stream, 1, 0) > 0 && (stream.revents & POLLIN) == 0;
}

ReaderProcess::Arrival ReaderProcess::receive(std::span<std::byte> buffer, int milliseconds, std::size_t& received) {
  received = 0;
  std::array<pollfd, 2> wait{{{stream_.number(), POLLIN, 0}, {complaint_pipe_.number(), POLLIN, 0}}};
  if (poll(wait.data(), wait.size(), milliseconds) < 0 && errno != EINTR) {
    throw Error(std::string("cannot wait for the scene reader: ") + std::strerror(errno) + try_again);
  }
  drain_complaints();
  const ssize_t n = read(stream_.number(), buffer.data(), buffer.size());
  if (n > 0) {
    received = static_cast<std::size_t>(n);
    return Arrival::bytes;
  }
  if (n == 0) return Arrival::end;
  if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) return Arrival::nothing;
  throw Error(std::string("cannot read from the scene reader: ") + std::strerror(errno) + try_again);
}

void ReaderProcess::drain_complaints() {
  std::array<char, 4096> chunk;
  // Bounded, so that endless output of the child does not delay reading its stream.
  for (int i = 0; i < 16; ++i) {
    const ssize_t n = read(complaint_pipe_.number(), chunk.data(), chunk.size());
    if (n == 0) {
      // The child has closed both outputs. An open descriptor here would wake poll() again and again.
      complaint_pipe_.close();
    }
    if (n <= 0) return;
    complaints_.append(chunk.data(), static_cast<std::size_t>(n));
    if (complaints_.size() > complaint_limit) complaints_.erase(0, complaints_.size() - complaint_limit);
  }
}

Ending ReaderProcess::finish(int milliseconds) {
  if (!child_->wait(std::chrono::milliseconds(milliseconds))) child_->end(std::chrono::milliseconds(0));
  drain_complaints();
  return child_->ending();
}

}  // namespace roam::reader
