#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "cli/interrupt.h"
#include "cli/tell.h"

namespace roam::app {
namespace {

using namespace std::chrono_literals;

// The eye follows a few changes a second; a log wants few lines.
constexpr auto terminal_period = 200ms;
constexpr auto log_period = 10s;

}  // namespace

std::string short_count(double count) {
  constexpr const char* suffix[] = {"", " k", " M", " G", " T"};
  int power = 0;
  while (count >= 999.5 && power < 4) {
    count /= 1000.0;
    ++power;
  }
  if (power == 0) return fmt::format("{:.0f}", count);
  return fmt::format("{:.{}f}{}", count, count < 9.995 ? 2 : count < 99.95 ? 1 : 0, suffix[power]);
}

std::string short_time(double seconds) {
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long long>(seconds + 0.5);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

Progress::Progress(const std::string& what, std::string unit, Rate rate)
    : what_(printable_part(what)), unit_(std::move(unit)), rate_(rate), terminal_(isatty(STDERR_FILENO) != 0) {
  next_ = start_ + (terminal_ ? Clock::duration(terminal_period) : Clock::duration(log_period));
}

Progress::~Progress() {
  if (line_is_open_) std::fputs("\r\x1b[K", stderr);
}

void Progress::at(std::uint64_t done, std::uint64_t total) {
  stop_if_interrupted();
  if (Clock::now() >= next_) show(done, total);
}

bool Progress::goes_on(std::uint64_t done, std::uint64_t total) {
  if (interrupted()) return false;
  if (Clock::now() >= next_) show(done, total);
  return true;
}

void Progress::show(std::uint64_t done, std::uint64_t total) {
  const auto now = Clock::now();
  next_ = now + (terminal_ ? Clock::duration(terminal_period) : Clock::duration(log_period));
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double rate = static_cast<double>(done) / seconds;
  std::string text = fmt::format("{}: ", what_);
  if (total > 0) {
    const double fraction = static_cast<double>(done) / static_cast<double>(total);
    text += fmt::format("{:.0f} %", 100.0 * fraction);
    if (!unit_.empty()) {
      text += fmt::format(", {} of {} {}, {} {}/s", short_count(static_cast<double>(done)),
                          short_count(static_cast<double>(total)), unit_, short_count(rate), unit_);
    }
    if (rate_ == Rate::even && done > 0 && done < total)
      text += ", " + short_time((1.0 / fraction - 1.0) * seconds) + " left";
  } else {
    text += fmt::format("{} {}, {} {}/s", short_count(static_cast<double>(done)), unit_, short_count(rate), unit_);
  }
  if (terminal_) {
    fmt::print(stderr, "\r\x1b[K{}", text);
    line_is_open_ = true;
  } else {
    fmt::print(stderr, "{}\n", text);
  }
  std::fflush(stderr);
}

}  // namespace roam::app
