#pragma once
/// \file
/// Counter-based noise: every value is a hash of the seed and of integers, so it needs no state, no order and no
/// library. It uses only + - * / of doubles, so all machines give the same bits.

#include <cstdint>

#include "math/mix.h"

namespace roam::generate {

[[nodiscard]] inline std::uint64_t hash(std::uint64_t seed, std::int64_t a, std::int64_t b = 0) {
  return mix(mix(seed ^ static_cast<std::uint64_t>(a)) ^ static_cast<std::uint64_t>(b));
}

/// The upper 53 bits of a hash as a number in [0, 1).
[[nodiscard]] inline double unit(std::uint64_t h) { return static_cast<double>(h >> 11) * 0x1p-53; }

/// A number in [low, high) that depends on the seed and two integers.
[[nodiscard]] inline double uniform(double low, double high, std::uint64_t seed, std::int64_t a, std::int64_t b = 0) {
  return low + (high - low) * unit(hash(seed, a, b));
}

/// The largest integer not above x, for -2^62 < x < 2^62.
[[nodiscard]] inline std::int64_t floor_int(double x) {
  const auto i = static_cast<std::int64_t>(x);
  return i - (static_cast<double>(i) > x);
}

/// 0 below 0, 1 above 1, and between them the smooth curve 3 x^2 - 2 x^3.
[[nodiscard]] inline double smooth(double x) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  return x * x * (3.0 - 2.0 * x);
}

/// Value noise in [-1, 1] with features of size 1.
[[nodiscard]] inline double value_noise(std::uint64_t seed, double x, double y) {
  const std::int64_t i = floor_int(x), j = floor_int(y);
  const double u = smooth(x - static_cast<double>(i)), v = smooth(y - static_cast<double>(j));
  const double a = unit(hash(seed, i, j)), b = unit(hash(seed, i + 1, j));
  const double c = unit(hash(seed, i, j + 1)), d = unit(hash(seed, i + 1, j + 1));
  const double low = a + (b - a) * u, high = c + (d - c) * u;
  return 2.0 * (low + (high - low) * v) - 1.0;
}

/// Gradient noise in about [-1, 1] with features of size 1 (Perlin, "Improving noise", 2002, in two dimensions with
/// eight gradients).
[[nodiscard]] inline double gradient_noise(std::uint64_t seed, double x, double y) {
  const auto slope = [](std::uint64_t h, double dx, double dy) {
    const double a = (h & 1u) ? dx : dy, b = (h & 1u) ? dy : dx;
    const double weight = (h & 8u) ? 0.5 : 1.0;
    return ((h & 2u) ? -a : a) + ((h & 4u) ? -b : b) * weight;
  };
  const auto fade = [](double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); };
  const std::int64_t i = floor_int(x), j = floor_int(y);
  const double dx = x - static_cast<double>(i), dy = y - static_cast<double>(j);
  const double u = fade(dx), v = fade(dy);
  const double a = slope(hash(seed, i, j), dx, dy), b = slope(hash(seed, i + 1, j), dx - 1.0, dy);
  const double c = slope(hash(seed, i, j + 1), dx, dy - 1.0), d = slope(hash(seed, i + 1, j + 1), dx - 1.0, dy - 1.0);
  const double low = a + (b - a) * u, high = c + (d - c) * u;
  return low + (high - low) * v;
}

/// Gradient noise for one octave of a sum. Gradient noise is 0 at all integers. Octaves of halved size would share
/// these zeros and draw a cross through the sum, so each octave has its own offset.
[[nodiscard]] inline double octave_noise(std::uint64_t seed, int octave, double x, double y) {
  constexpr double farthest = 256.0;
  const std::uint64_t own = seed + static_cast<std::uint64_t>(octave);
  return gradient_noise(own, x + uniform(0.0, farthest, own, 1), y + uniform(0.0, farthest, own, 2));
}

}  // namespace roam::generate
