#pragma once
/// \file
/// A box with three sets of grid lines: a room seen from inside, or a solid seen from outside.

#include <cstdint>
#include <memory>
#include <vector>

#include "generate/surface.h"

namespace roam::generate {

/// The lattice of points corner + a[i] * ahead + b[j] * up + c[k] * aside. `aside` points to the left of `ahead`.
struct Block {
  Vec3 corner{0.0};
  Vec3 ahead{1.0, 0.0, 0.0}, aside{0.0, 1.0, 0.0};  ///< level unit vectors, square to each other
  std::vector<double> a, b, c;                      ///< metres, ascending
  double roughness = 0.0;                           ///< m; zero on the floor b[0] and on the front c[0]
  std::uint64_t seed = 0;

  [[nodiscard]] Vec3 point(int i, int j, int k) const;
};

/// front and back are at c[0] and c.back(), with rows along a and columns along b. floor and roof have rows along a and
/// columns along c. near_end and far_end are at a[0] and a.back(), with rows along b and columns along c.
enum class Side { front, back, floor, roof, near_end, far_end };

/// One side of a block, wound to be seen from inside (a room) or from outside (a solid).
[[nodiscard]] Grid block_side(const std::shared_ptr<const Block>& block, Side side, bool from_inside);

/// Adds a closed solid seen from outside.
void add_body(Part& part, const std::shared_ptr<const Block>& block);

/// Adds a closed upright cylinder that stands on `foot`.
void add_cylinder(Part& part, const Vec3& foot, double radius, double height, double cell);

}  // namespace roam::generate
