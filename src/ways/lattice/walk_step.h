#pragma once
/// \file
/// Queries of the scene about one step between neighbouring lattice places. The results do not depend on the places
/// known so far or on the order of calls. Safe for any number of threads.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "ways/lattice/table.h"
#include "ways/lattice/walk_place.h"

namespace roam::ways {

/// A place of the feet, and how wide a body may be there.
struct Standing {
  Vec3 place{0.0};
  double level = 0.0;  ///< see FloorPlace
  double free = 0.0;
  bool over_gap = false;
  bool operator==(const Standing&) const = default;
};

[[nodiscard]] inline Standing standing_at(const FloorPlace& foot, float clearance) {
  return {foot.place, foot.level, clearance, foot.over_gap};
}

/// Steps to the eight lattice points around a place, counter-clockwise. The opposite of a direction is four further.
inline constexpr std::size_t directions = 8;
[[nodiscard]] constexpr std::size_t opposite(std::size_t direction) {
  return (direction + directions / 2) % directions;
}
[[nodiscard]] inline LatticePoint beside(const LatticePoint& at, std::size_t direction) {
  constexpr std::array<std::int32_t, directions> x{1, 1, 0, -1, -1, -1, 0, 1}, y{0, 1, 1, 1, 0, -1, -1, -1};
  return {at.x + x[direction], at.y + y[direction], at.z};
}

/// The position of a lattice's points.
struct LatticePlan {
  double spacing = 0.0;
  Vec3 origin{0.0};
  [[nodiscard]] Vec3 point(const LatticePoint& p) const { return origin + Vec3(spacing * p.x, spacing * p.y, 0.0); }
};

class WalkSteps {
 public:
  WalkSteps(const Survey& survey, const Measure& measure)
      : survey_(survey), measure_(measure), largest_(largest_radius(measure)) {}

  /// The clearance of a place where nothing limits a body.
  [[nodiscard]] float unlimited() const { return rounded_down(largest_); }

  /// The foot at (x, y) of a step from a place: straight, else with one step between. It crosses cracks only where the
  /// knee meets no wall.
  [[nodiscard]] std::optional<FloorPlace> foot_from(const Standing& from, const Vec3& to) const;
  /// As clearance_at, rounded down; 0 if no body of `narrowest` can be there.
  [[nodiscard]] float clearance(const Vec3& place) const;
  /// Whether a body of `narrowest` gets from one free place to another.
  [[nodiscard]] bool linked(const Standing& a, const Standing& b) const;
  /// Whether a walker gets from one place to another, one of which is over a gap. Its support disc is the largest: the
  /// gap may have floor within a step, or continue into an open drop.
  [[nodiscard]] bool walked(const Standing& a, const Standing& b) const;

 private:
  [[nodiscard]] static float rounded_down(double radius);

  const Survey& survey_;
  const Measure measure_;
  const double largest_;
  mutable KnownGaps gaps_;
};

}  // namespace roam::ways
