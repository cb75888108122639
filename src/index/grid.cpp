#include "index/grid.h"

#include <cmath>

#include "math/largest.h"
#include "roam/space.h"

namespace roam::index {

Grid Grid::fitting(const Box& box) {
  const double extent = largest(box.size());
  int exponent = finest_exponent;
  for (;; ++exponent) {
    Grid grid;
    grid.step = std::ldexp(1.0, exponent);
    // One step is lost to rounding the origin down, and one to rounding the far side up.
    if (extent > grid.step * double(grid_steps - 2)) continue;
    for (int k = 0; k < 3; ++k) grid.origin[k] = std::floor(box.lower[k] / grid.step) * grid.step;
    return grid;
  }
}

Grid Grid::over(const Box& box) {
  const double extent = largest(box.size() + Vec3(8.0 * Space::reach_limit));
  Grid grid;
  grid.step = std::ldexp(1.0, std::ilogb(extent) + 1 - 29);
  for (int k = 0; k < 3; ++k) grid.origin[k] = std::floor(box.lower[k] / grid.step) * grid.step;
  return grid;
}

StepBox Grid::steps(const Box& box) const {
  StepBox out;
  for (int k = 0; k < 3; ++k) {
    out.lower[k] = static_cast<std::int32_t>(std::floor((box.lower[k] - origin[k]) / step));
    out.upper[k] = static_cast<std::int32_t>(std::ceil((box.upper[k] - origin[k]) / step));
  }
  return out;
}

std::array<std::int64_t, 3> Grid::fine(const Vec3& p) const {
  std::array<std::int64_t, 3> f{};
  // Both are powers of two, so the product equals the quotient to the last bit.
  const double per_metre = double(fine_steps) / step;
  for (int k = 0; k < 3; ++k) {
    // llround of numbers below 2^52, without the call: the largest double below 1/2 carries exactly the values that
    // round up.
    const double x = (p[k] - origin[k]) * per_metre;
    f[k] = static_cast<std::int64_t>(x + std::copysign(0x1.fffffffffffffp-2, x));
  }
  return f;
}

}  // namespace roam::index
