#pragma once
/// \file
/// Progress of long work on standard error.

#include <chrono>
#include <cstdint>
#include <string>

namespace roam::app {

/// A number of things for display: "950", "12.3 k", "4.56 M", "1.2 G".
[[nodiscard]] std::string short_count(double count);

/// A duration for display: "0.8 s", "42 s", "3 min 10 s", "2 h 5 min".
[[nodiscard]] std::string short_time(double seconds);

/// Shows the progress, speed and remaining time of some work. On a terminal it rewrites one line, and removes it at the
/// end. Elsewhere it writes a plain line now and then. Short work shows nothing.
class Progress {
 public:
  /// `what` is the work and `unit` its unit, e.g. "reading mine.dae" and "B", or "indexing" and "triangles". An empty
  /// unit shows only the share done.
  ///
  /// The remaining time follows from the rate so far. `rate` is `uneven` if that does not predict the rest.
  enum class Rate : std::uint8_t { even, uneven };
  Progress(const std::string& what, std::string unit, Rate rate = Rate::even);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Throws roam::Cancelled after Ctrl-C.
  void at(std::uint64_t done, std::uint64_t total);
  /// The same for callbacks that return false to cancel.
  [[nodiscard]] bool goes_on(std::uint64_t done, std::uint64_t total);

 private:
  void show(std::uint64_t done, std::uint64_t total);

  using Clock = std::chrono::steady_clock;
  std::string what_;
  std::string unit_;
  Rate rate_;
  bool terminal_;
  bool line_is_open_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_;
};

}  // namespace roam::app
