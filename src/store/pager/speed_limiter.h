#pragma once
/// \file
/// How fast a body may go, so that what it comes to is known by then.

#include "store/pager/paged_item.h"
#include "store/pager/residents.h"
#include "store/pager/tracked_body.h"

namespace roam::paging {

/// Of the thread that moves the body.
class SpeedLimiter {
 public:
  explicit SpeedLimiter(double horizon) : horizon_(horizon) {}

  /// Looks how far everything is known around the body, or concludes it from when it looked last. `changed`: something
  /// came or went; `complete`: everything is there.
  void look(const Residents& residents, const TrackedBody& tracked, double latency, bool changed, bool complete);
  /// Whether anything within `reach` (m) of the body is unknown and has not failed.
  [[nodiscard]] static bool anything_coming(const Residents& residents, const TrackedBody& tracked, double reach);

  [[nodiscard]] double limit() const { return limit_; }
  [[nodiscard]] double ready() const { return ready_; }
  [[nodiscard]] double latency() const { return latency_; }

 private:
  /// Metres per second. Nobody need stand still, for nothing unknown lets anybody through.
  static constexpr double least_limit = 0.5;

  double horizon_;
  double limit_ = least_limit, ready_ = 0.0, latency_ = 0.0;
  // Where it looked last, how far, and what it found.
  Vec3 place_{0.0};
  double radius_ = -1.0, half_height_ = -1.0, reach_ = 0.0, found_ = 0.0;
};

}  // namespace roam::paging
