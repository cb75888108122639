#include "graphics/xvfb.h"

#include <charconv>
#include <chrono>
#include <string>
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

}  // namespace

Xvfb::Xvfb(int width, int height, bool resets) {
  const std::filesystem::path program = process::find_program("Xvfb");
  if (program.empty()) throw Error("the program Xvfb is not on the PATH");
  process::Lines lines;
  const std::string size = std::to_string(width) + "x" + std::to_string(height) + "x24";
  std::vector<std::string> arguments{
      "-displayfd", std::to_string(display_descriptor), "-screen", "0", size, "-nolisten", "tcp", "+extension", "GLX"};
  if (!resets) arguments.emplace_back("-noreset");
  process_ = std::make_unique<process::Child>(
      program, arguments, process::ChildSettings{.descriptors = {{lines.theirs(), display_descriptor}}});
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

}  // namespace roam::graphics
