#include "cli/histogram.h"

#include <algorithm>
#include <cmath>

namespace roam::app {

void Histogram::add(double value) {
  const double position = value > 1.0 ? std::log2(value) * buckets_an_octave : 0.0;
  const auto bucket = static_cast<std::size_t>(std::min(position, static_cast<double>(counts_.size() - 1)));
  ++counts_[bucket];
  ++count_;
  largest_ = std::max(largest_, value);
}

double Histogram::quantile(double q) const {
  if (count_ == 0) return 0.0;
  const auto rank = static_cast<std::uint64_t>(std::clamp(q, 0.0, 1.0) * static_cast<double>(count_ - 1));
  std::uint64_t seen = 0;
  std::size_t bucket = 0;
  while (bucket + 1 < counts_.size() && seen + counts_[bucket] <= rank) seen += counts_[bucket++];
  // The middle of the bucket, but at most the largest value.
  return std::min(std::exp2((static_cast<double>(bucket) + 0.5) / buckets_an_octave), largest_);
}

}  // namespace roam::app
