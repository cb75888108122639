#pragma once
/// \file
/// Whether pictures take too long to draw.

#include <algorithm>
#include <optional>
#include <vector>

namespace roam::app {

/// Judges the times of frames by their median, so that a few slow ones, such as those of stills, do not count.
class Thrift {
 public:
  static constexpr double slowest = 1000.0 / 15.0;  ///< ms: at fewer than 15 pictures a second one does not walk well
  static constexpr std::size_t frames = 60;

  /// After each block of so many frames: their median if it is above `slowest`. Else none.
  [[nodiscard]] std::optional<double> take(double ms) {
    times_.push_back(ms);
    if (times_.size() < frames) return std::nullopt;
    const auto middle = times_.begin() + frames / 2;
    std::nth_element(times_.begin(), middle, times_.end());
    const double median = *middle;
    times_.clear();
    return median > slowest ? std::optional(median) : std::nullopt;
  }

 private:
  std::vector<double> times_;
};

}  // namespace roam::app
