#include "graphics/xvfb.h"

#include <X11/Xlib.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "process/find_program.h"
#include "process/lines.h"
#include "roam/error.h"

namespace roam::graphics {
namespace {

/// Xvfb starts within a second even on a slow machine. After this time it counts as failed.
constexpr std::chrono::seconds patience{30};
/// The child's descriptor for -displayfd.
constexpr int display_descriptor = 3;
/// The child's descriptor for -auth.
constexpr int authority_descriptor = 4;
constexpr std::string_view protocol = "MIT-MAGIC-COOKIE-1";

/// A file in memory as Xau(3) describes it: of any host (family 65535) and any display.
files::Descriptor authority_of(std::span<const unsigned char> cookie) {
  std::string entry("\xFF\xFF\0\0\0\0", 6);
  const auto add = [&](const auto& text) {
    entry += {static_cast<char>(text.size() >> 8U), static_cast<char>(text.size())};
    entry.append(text.begin(), text.end());
  };
  add(protocol);
  add(cookie);
  files::Descriptor file(::memfd_create("Xauthority", MFD_CLOEXEC));
  if (!file.is_open() || files::write_fully(file.number(), std::as_bytes(std::span(entry))) < entry.size()) {
    throw Error(std::string("cannot keep the cookie of Xvfb: ") + std::strerror(errno));
  }
  return file;
}

}  // namespace

Xvfb::Xvfb(int width, int height, bool resets) {
  const std::filesystem::path program = process::find_program("Xvfb");
  if (program.empty()) throw Error("the program Xvfb is not on the PATH");
  if (::getrandom(cookie_.data(), cookie_.size(), 0) != static_cast<ssize_t>(cookie_.size())) {
    throw Error(std::string("cannot make a cookie for Xvfb: ") + std::strerror(errno));
  }
  authority_ = authority_of(cookie_);
  process::Lines lines;
  const std::string size = std::to_string(width) + "x" + std::to_string(height) + "x24";
  std::vector<std::string> arguments{"-displayfd", std::to_string(display_descriptor),
                                     "-auth",      "/proc/self/fd/" + std::to_string(authority_descriptor),
                                     "-screen",    "0",
                                     size,         "-nolisten",
                                     "tcp",        "+extension",
                                     "GLX"};
  if (!resets) arguments.emplace_back("-noreset");
  process_ = std::make_unique<process::Child>(
      program, arguments,
      process::ChildSettings{
          .descriptors = {{lines.theirs(), display_descriptor}, {authority_.number(), authority_descriptor}}});
  lines.child_has_started();

  // Xvfb writes the line when it accepts connections.
  const std::string line = lines.next(patience).value_or("");
  const auto [end, problem] = std::from_chars(line.data(), line.data() + line.size(), display_);
  if (problem != std::errc() || display_ < 0) {
    process_->end();
    const std::string words = process_->last_words();
    throw Error("Xvfb did not start" + (words.empty() ? std::string() : ": " + words));
  }
}

void Xvfb::authorize() const {
  std::string name(protocol);
  std::vector<char> data(cookie_.begin(), cookie_.end());
  XSetAuthorization(name.data(), static_cast<int>(name.size()), data.data(), static_cast<int>(data.size()));
}

std::string Xvfb::authority() const {
  return "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(authority_.number());
}

}  // namespace roam::graphics
