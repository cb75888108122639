#pragma once
/// \file
/// The body that a pager reads for, and how soon it could reach a box.

#include "roam/math.h"
#include "roam/sweep.h"

namespace roam::paging {

/// The body that a pager was updated with last.
class TrackedBody {
 public:
  TrackedBody() = default;
  TrackedBody(const Body& body, const Vec3& place, const Vec3& velocity);

  /// Seconds until the body could be at the box: soonest straight ahead, twice as late to the side, thrice behind.
  [[nodiscard]] double time_to(const Box& box) const;
  /// Whether the box is so near that it must stay as it is, lest the body come to be in something unknown.
  [[nodiscard]] bool holds(const Box& box) const;
  /// Metres between the body's surface and the box.
  [[nodiscard]] double gap(const Box& box) const;
  /// Metres per second that it may have soon.
  [[nodiscard]] double pace() const { return pace_; }
  [[nodiscard]] double speed() const { return speed_; }
  [[nodiscard]] const Body& body() const { return body_; }
  [[nodiscard]] const Vec3& place() const { return place_; }
  /// Whether what was planned for `other` serves this one too.
  [[nodiscard]] bool like(const TrackedBody& other) const;

 private:
  /// From the body's axis to the nearest point of the box.
  [[nodiscard]] Vec3 way_to(const Box& box) const;

  Body body_;
  Vec3 place_{0.0}, velocity_{0.0};
  double speed_ = 0.0, pace_ = 1.0;
};

}  // namespace roam::paging
