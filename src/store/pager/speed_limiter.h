#pragma once
/// \file
/// The speed at which a body reaches no space before it is loaded.

#include "store/pager/paged_item.h"
#include "store/pager/residents.h"
#include "store/pager/tracked_body.h"

namespace roam::paging {

/// Used by the thread that moves the body.
class SpeedLimiter {
 public:
  explicit SpeedLimiter(double horizon) : horizon_(horizon) {}

  /// Updates the distance within which all space around the body is known, by a search or from the last search.
  /// `changed`: an item came or went. `complete`: all items are in memory. `latency` is the time to load an item, in
  /// seconds.
  void look(const Residents& residents, const TrackedBody& tracked, double latency, bool changed, bool complete);
  /// For a body that waits before its next step: the limit until the next look().
  void forget_latency();
  /// Whether any item within `reach` (m) of the body is unknown and has not failed.
  [[nodiscard]] static bool anything_coming(const Residents& residents, const TrackedBody& tracked, double reach);

  [[nodiscard]] double limit() const { return limit_; }
  [[nodiscard]] double ready() const { return ready_; }
  [[nodiscard]] double latency() const { return latency_; }

 private:
  /// Metres per second. A body need never stand still, because unknown space is solid.
  static constexpr double least_limit = 0.5;

  double horizon_;
  double limit_ = least_limit, ready_ = 0.0, latency_ = 0.0;
  // The position, body, reach and result of the last search.
  Vec3 place_{0.0};
  double radius_ = -1.0, half_height_ = -1.0, reach_ = 0.0, found_ = 0.0;
};

}  // namespace roam::paging
