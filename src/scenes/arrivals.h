#pragma once
/// \file
/// Waits for a pager's loads, as long as any arrive or are on their way.

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>

#include "roam/pager.h"

namespace roam::app {

/// Waits while anything arrives, or is being read.
class Arrivals {
 public:
  /// Seconds without an arrival after which reads in progress count as none: the disk or the server is stuck.
  static constexpr double stuck_after = 60.0;

  explicit Arrivals(Pager& pager, double stuck = stuck_after);

  /// Waits a moment for everything that a body at `place` could reach within `ahead` s at `velocity`. Returns whether
  /// more of it may arrive: not if all is there, memory is full, or nothing has arrived for `stuck` seconds.
  bool wait(const Body& body, const Vec3& place, const Vec3& velocity, double ahead = 1.0);
  /// Whether all of it is loaded, except unreadable tiles.
  [[nodiscard]] bool settled() const { return settled_; }
  /// Whether nothing has arrived for `stuck` seconds.
  [[nodiscard]] bool stuck() const { return silence() >= stuck_; }
  /// Seconds since anything arrived.
  [[nodiscard]] double silence() const;

 private:
  using Clock = std::chrono::steady_clock;

  Pager& pager_;
  double stuck_;
  std::uint64_t loads_;
  Clock::time_point last_ = Clock::now(), read_ = last_;
  bool settled_ = false;
};

/// Waits for the surroundings of places, as far as memory allows: for work that is not done in real time.
class TilesAround {
 public:
  /// Seconds in which a body would reach its surroundings. A pager loads all that is within six times this time ahead,
  /// and within this time behind.
  static constexpr double ahead = 0.5;
  /// Metres that are worth waiting for around a body, however slow it is.
  static constexpr double least_reach = 4.0;

  /// `goes_on`: waits end when it returns false. `stuck`: see Arrivals.
  TilesAround(Pager& pager, std::function<bool()> goes_on, double stuck = Arrivals::stuck_after);

  /// Waits until everything readable within `reach` (m) of a body, and within `ahead` at `velocity`, is loaded;
  /// what lies in its direction comes first. Tiles that a web server may still send count as readable until nothing has
  /// come for `stuck` seconds: the pager tries them again. If memory is too small for it, waits until nothing more
  /// arrives, and then for a smaller reach. If nothing arrives for `stuck` seconds, says so on standard error, and
  /// waits no more until something arrives.
  void wait(const Body& body, const Vec3& place, const Vec3& velocity, double reach);

 private:
  [[nodiscard]] bool failed_may_come();

  Pager& pager_;
  std::function<bool()> goes_on_;
  double stuck_;
  double fits_ = std::numeric_limits<double>::infinity();               ///< metres, as far as known
  std::uint64_t stuck_at_ = std::numeric_limits<std::uint64_t>::max();  ///< loads when nothing more arrived
  std::uint64_t lost_ = 0;                                              ///< failed tiles that are no longer waited for
};

}  // namespace roam::app
