#pragma once
/// \file
/// Numbers that are drawn by a seed, the same on every machine; standard distributions are not.

#include <bit>
#include <cstdint>

#include "roam/math.h"

namespace roam::training {

/// Mixes 64 bits (the finalizer of splitmix64: Steele, Lea, Flood, "Fast splittable pseudorandom number generators",
/// 2014).
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t z) {
  z += 0x9E3779B97F4A7C15ULL;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

/// Of a place, to the last bit.
[[nodiscard]] inline std::uint64_t hashed(const Vec3& p, std::uint64_t seed = 0) {
  for (int k = 0; k < 3; ++k) seed = mixed(seed ^ std::bit_cast<std::uint64_t>(p[k]));
  return seed;
}

/// In [0, 1).
[[nodiscard]] constexpr double unit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

/// A sequence of draws.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(mixed(seed)) {}
  /// Below `n`, which is at least 1.
  [[nodiscard]] std::uint64_t below(std::uint64_t n) { return (state_ = mixed(state_)) % n; }

 private:
  std::uint64_t state_;
};

}  // namespace roam::training
