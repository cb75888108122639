#include "graphics/xvfb.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <string>

#include "process/find_program.h"
#include "roam/error.h"

namespace roam::graphics {
namespace {

/// Xvfb starts within a second even on a slow machine. After this time it counts as failed.
constexpr std::chrono::seconds patience{30};
/// The child's descriptor for -displayfd.
constexpr int display_descriptor = 3;

struct Pipe {
  int ends[2] = {-1, -1};
  Pipe() {
    if (pipe2(ends, O_CLOEXEC) != 0) throw Error(std::string("cannot open a pipe to Xvfb: ") + std::strerror(errno));
  }
  ~Pipe() {
    close(ends[0]);
    close_write_end();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_write_end() {
    if (ends[1] >= 0) close(ends[1]);
    ends[1] = -1;
  }
};

/// The line that Xvfb writes when it accepts connections; incomplete if it does not.
std::string read_line(int descriptor) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + patience;
  std::string line;
  while (line.find('\n') == std::string::npos) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd wait{descriptor, POLLIN, 0};
    if (left <= 0 || (poll(&wait, 1, static_cast<int>(left)) < 0 && errno != EINTR)) break;
    char chunk[32];
    const ssize_t n = wait.revents != 0 ? read(descriptor, chunk, sizeof chunk) : 0;
    if (n > 0) line.append(chunk, static_cast<std::size_t>(n));
    if (wait.revents != 0 && n == 0) break;
  }
  return line;
}

}  // namespace

Xvfb::Xvfb(int width, int height) {
  const std::filesystem::path program = process::find_program("Xvfb");
  if (program.empty()) throw Error("the program Xvfb is not on the PATH");
  Pipe pipe;
  const std::string size = std::to_string(width) + "x" + std::to_string(height) + "x24";
  process_ = std::make_unique<process::Child>(
      program,
      std::vector<std::string>{"-displayfd", std::to_string(display_descriptor), "-screen", "0", size, "-nolisten",
                               "tcp", "-noreset", "+extension", "GLX"},
      process::ChildSettings{.descriptors = {{pipe.ends[1], display_descriptor}}});
  pipe.close_write_end();

  const std::string line = read_line(pipe.ends[0]);
  const auto [end, problem] = std::from_chars(line.data(), line.data() + line.size(), display_);
  if (problem != std::errc() || display_ < 0) {
    process_->end();
    const std::string words = process_->last_words();
    throw Error("Xvfb did not start" + (words.empty() ? std::string() : ": " + words));
  }
}

}  // namespace roam::graphics
