#pragma once
/// \file
/// What the scene answers about one step from a place of the lattice to the next. Nothing here depends on which places
/// are known by now, or on who asks first: it may be asked ahead, from any number of threads.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "ways/lattice/table.h"
#include "ways/lattice/walk_place.h"

namespace roam::ways {

/// A foot, and how wide a body may be there.
struct Standing {
  Vec3 place{0.0};
  double level = 0.0;  ///< see Foot
  double free = 0.0;
  bool carried = false;
  bool operator==(const Standing&) const = default;
};

[[nodiscard]] inline Standing standing_at(const Foot& foot, float clearance) {
  return {foot.place, foot.level, clearance, foot.carried};
}

/// Of the steps to the points of the lattice around a place, counter-clockwise: the opposite of one is four further.
inline constexpr std::size_t directions = 8;
[[nodiscard]] constexpr std::size_t opposite(std::size_t direction) {
  return (direction + directions / 2) % directions;
}
[[nodiscard]] inline LatticePoint beside(const LatticePoint& at, std::size_t direction) {
  constexpr std::array<std::int32_t, directions> x{1, 1, 0, -1, -1, -1, 0, 1}, y{0, 1, 1, 1, 0, -1, -1, -1};
  return {at.x + x[direction], at.y + y[direction], at.z};
}

/// Where the points of a lattice lie.
struct LatticePlan {
  double spacing = 0.0;
  Vec3 origin{0.0};
  [[nodiscard]] Vec3 point(const LatticePoint& p) const { return origin + Vec3(spacing * p.x, spacing * p.y, 0.0); }
};

class WalkSteps {
 public:
  WalkSteps(const Survey& survey, const Measure& measure)
      : survey_(survey), measure_(measure), largest_(largest_radius(measure)) {}

  /// The clearance where nothing limits a body.
  [[nodiscard]] float unlimited() const { return rounded_down(largest_); }

  /// Where a foot comes to that goes from a place to (x, y): straight, else with one step between; over cracks only
  /// where the knee meets no wall.
  [[nodiscard]] std::optional<Foot> foot_from(const Standing& from, const Vec3& to) const;
  /// As clearance_at, rounded down; 0 where no body of `narrowest` can be.
  [[nodiscard]] float clearance(const Vec3& place) const;
  /// Whether a body of `narrowest` gets from one free place to another.
  [[nodiscard]] bool linked(const Standing& a, const Standing& b) const;
  /// Whether a walker gets from one place to another where one of them is over a gap: on the largest foot, for what
  /// lies in the gap may still be within a step, or the gap go on into an open drop. So one goes there.
  [[nodiscard]] bool walked(const Standing& a, const Standing& b) const;

 private:
  [[nodiscard]] static float rounded_down(double radius);

  const Survey& survey_;
  const Measure measure_;
  const double largest_;
  mutable KnownGaps gaps_;
};

}  // namespace roam::ways
