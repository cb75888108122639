#pragma once
/// \file
/// Whether pictures take too long to draw.

#include <algorithm>
#include <optional>
#include <vector>

namespace roam::app {

/// Judges the times of frames by their median, so that a few slow ones, such as those of stills, do not count; and only
/// by two blocks in a row, because a short load of the machine is no reason to draw less. The second block counts the
/// time of drawing alone: a screen takes the pictures of a covered window, or of one on another desktop, once a second
/// or so, and may draw them at its lowest power.
class Thrift {
 public:
  static constexpr double slowest = 1000.0 / 15.0;  ///< ms: at fewer than 15 pictures a second one does not walk well
  static constexpr std::size_t frames = 60;

  /// Whether the next frame belongs to a second block: the last one was slow.
  [[nodiscard]] bool doubts() const { return was_slow_; }
  /// `ms`: of a whole frame. `drawn_ms`: without its waits for the screen; counts only if doubts(). After two blocks of
  /// so many frames: the median of the second if both medians are above `slowest`. Else none.
  [[nodiscard]] std::optional<double> take(double ms, double drawn_ms) {
    if (doubts() && ms > slowest) {
      if (drawn_ms < 0.5 * ms) return std::nullopt;  // the screen decides
      ms = drawn_ms;
    }
    times_.push_back(ms);
    if (times_.size() < frames) return std::nullopt;
    const auto middle = times_.begin() + frames / 2;
    std::nth_element(times_.begin(), middle, times_.end());
    const double median = *middle;
    times_.clear();
    const bool slow = median > slowest, twice = slow && was_slow_;
    was_slow_ = slow && !twice;
    return twice ? std::optional(median) : std::nullopt;
  }

 private:
  std::vector<double> times_;
  bool was_slow_ = false;  ///< the block before
};

}  // namespace roam::app
