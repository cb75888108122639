#pragma once
/// \file
/// Progress of long work on standard error.

#include <chrono>
#include <cstdint>
#include <string>

namespace roam::app {

/// A number of things for people: "950", "12.3 k", "4.56 M", "1.2 G".
[[nodiscard]] std::string short_count(double count);

/// A length of time for people: "0.8 s", "42 s", "3 min 10 s", "2 h 5 min".
[[nodiscard]] std::string short_time(double seconds);

/// Tells how far some work is, how fast it goes and how long it will take: on a terminal in one line that is rewritten
/// and goes away when the work ends, elsewhere in a plain line now and then. Work that is over quickly says nothing.
class Progress {
 public:
  /// `what` is being done, counted in `unit`, e.g. "reading mine.dae" and "B" or "indexing" and "triangles"; empty:
  /// only what share of it is done is told.
  ///
  /// The time left follows from the rate so far. `rate` is `uneven` where that says nothing about the rest.
  enum class Rate : std::uint8_t { even, uneven };
  Progress(const std::string& what, std::string unit, Rate rate = Rate::even);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Throws roam::Cancelled after Ctrl-C.
  void at(std::uint64_t done, std::uint64_t total);
  /// The same for callbacks that are asked to return false instead.
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
