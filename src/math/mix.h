#pragma once
/// \file
/// Pseudorandom bits, the same on every machine.

#include <cstdint>

namespace roam {

/// Mixes 64 bits (the finalizer of splitmix64: Steele, Lea, Flood, "Fast splittable pseudorandom number generators",
/// 2014).
[[nodiscard]] constexpr std::uint64_t mix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

}  // namespace roam
