#pragma once
/// \file
/// What is paged: tiles, and pages of the index; and how soon a body could reach them.

#include <cstdint>

#include "roam/math.h"
#include "roam/sweep.h"

namespace roam::paging {

/// A tile of a page, or the page itself.
struct Thing {
  static constexpr std::uint32_t none = UINT32_MAX;
  static constexpr std::uint32_t whole = UINT32_MAX;

  std::uint32_t page = none;
  std::uint32_t tile = whole;

  [[nodiscard]] bool is_page() const { return tile == whole; }
  bool operator==(const Thing&) const = default;
};

/// The body for which everything is done, as it was told last.
class Traveller {
 public:
  Traveller() = default;
  Traveller(const Body& body, const Vec3& place, const Vec3& velocity);

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
  [[nodiscard]] bool like(const Traveller& other) const;

 private:
  /// From the body's axis to the nearest point of the box.
  [[nodiscard]] Vec3 way_to(const Box& box) const;

  Body body_;
  Vec3 place_{0.0}, velocity_{0.0};
  double speed_ = 0.0, pace_ = 1.0;
};

}  // namespace roam::paging
