#include "process/lines.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "roam/error.h"

namespace roam::process {

Lines::Lines() {
  std::array<int, 2> ends{};
#ifdef __linux__
  const bool open = ::pipe2(ends.data(), O_CLOEXEC) == 0;
#else
  const bool open = ::pipe(ends.data()) == 0;
  for (const int end : ends) ::fcntl(end, F_SETFD, FD_CLOEXEC);
#endif
  if (!open) throw Error(std::string("cannot open a pipe: ") + std::strerror(errno) + "; close files or programs");
  ours_ = files::Descriptor(ends[0]);
  theirs_ = files::Descriptor(ends[1]);
}

std::optional<std::string> Lines::next(std::chrono::milliseconds longest) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + longest;
  for (;;) {
    if (const std::size_t end = text_.find('\n'); end != std::string::npos) {
      std::string line = text_.substr(0, end);
      text_.erase(0, end + 1);
      return line;
    }
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (ended_ || left < 0) return std::nullopt;
    pollfd wait{ours_.number(), POLLIN, 0};
    const int found = files::again([&] { return ::poll(&wait, 1, static_cast<int>(left)); });
    if (found == 0) return std::nullopt;
    std::array<char, 4096> chunk;
    const ssize_t n = files::again([&] { return ::read(ours_.number(), chunk.data(), chunk.size()); });
    if (n > 0) text_.append(chunk.data(), static_cast<std::size_t>(n));
    ended_ = n <= 0;
  }
}

}  // namespace roam::process
