#pragma once
/// \file
/// The body that a pager loads for, and the time until it could reach a box.

#include "roam/math.h"
#include "roam/sweep.h"

namespace roam::paging {

/// The body of the last update of a pager.
class TrackedBody {
 public:
  TrackedBody() = default;
  TrackedBody(const Body& body, const Vec3& place, const Vec3& velocity);

  /// Seconds until the body could reach the box. The time is twice as long to the side, and three times behind.
  [[nodiscard]] double time_to(const Box& box) const;
  /// Whether the box is so near that it must stay in memory, lest the body overlap unknown space.
  [[nodiscard]] bool holds(const Box& box) const;
  /// Metres between the body's surface and the box, less Pager::margin; at least 0.
  [[nodiscard]] double gap(const Box& box) const;
  /// The speed that the body may soon have, m/s.
  [[nodiscard]] double pace() const { return pace_; }
  [[nodiscard]] double speed() const { return speed_; }
  [[nodiscard]] const Body& body() const { return body_; }
  [[nodiscard]] const Vec3& place() const { return place_; }
  /// Whether a plan for `other` serves this body too.
  [[nodiscard]] bool like(const TrackedBody& other) const;

 private:
  /// The vector from the body's axis to the nearest point of the box.
  [[nodiscard]] Vec3 way_to(const Box& box) const;

  Body body_;
  Vec3 place_{0.0}, velocity_{0.0};
  double speed_ = 0.0, pace_ = 1.0;
};

}  // namespace roam::paging
