#pragma once
/// \file
/// Seeded random numbers, the same on every machine. The standard distributions are not.

#include <bit>
#include <cstdint>

#include "math/mix.h"
#include "roam/math.h"

namespace roam {

/// The hash of a point, to the last bit.
[[nodiscard]] inline std::uint64_t hashed(const Vec3& p, std::uint64_t seed = 0) {
  for (int k = 0; k < 3; ++k) seed = mix(seed ^ std::bit_cast<std::uint64_t>(p[k]));
  return seed;
}

/// A number in [0, 1).
[[nodiscard]] constexpr double unit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

/// A sequence of random numbers.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(mix(seed)) {}
  /// A number in [0, n); `n` is at least 1.
  [[nodiscard]] std::uint64_t below(std::uint64_t n) { return (state_ = mix(state_)) % n; }

 private:
  std::uint64_t state_;
};

}  // namespace roam
