#pragma once
/// \file
/// Quantiles of very many times, in little memory.

#include <array>
#include <cstdint>

namespace roam::app {

/// Counts positive values in buckets 1.1 % wide: a session of days takes no more memory than one of seconds.
class Histogram {
 public:
  /// Values from 1 to 2^40, e.g. nanoseconds up to 18 minutes. Values outside count as the nearest end.
  void add(double value);
  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// The value below which a share `q` in [0, 1] of all values lies, to 1 %; 0 if there are none.
  [[nodiscard]] double quantile(double q) const;
  /// Exact; 0 if there are no values.
  [[nodiscard]] double largest() const { return largest_; }

 private:
  static constexpr int buckets_an_octave = 64;
  static constexpr int octaves = 40;
  std::array<std::uint64_t, std::size_t{buckets_an_octave} * octaves> counts_{};
  std::uint64_t count_ = 0;
  double largest_ = 0.0;
};

}  // namespace roam::app
