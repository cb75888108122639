#pragma once
/// \file
/// The progress of training, and whether it is to end.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>
#include <utility>

#include "roam/train.h"

namespace roam::training {

/// The range of the whole work that a stage covers, in [0, 1]. Rough, because scenes differ. Only a complete training
/// reaches 1.
[[nodiscard]] constexpr std::pair<double, double> part_of_work(TrainStage stage) {
  constexpr std::pair<double, double> parts[] = {{0.0, 0.4},  {0.4, 0.5},   {0.5, 0.65}, {0.65, 0.8},
                                                 {0.8, 0.85}, {0.85, 0.99}, {0.5, 0.99}};
  return parts[static_cast<std::size_t>(stage)];
}

/// Passes progress on, one thread at a time. Once the caller wants an end, every later call returns false. The reported
/// value never falls, even if a stage begins again. Safe to call from any thread, except begin() and complete().
class Stages {
 public:
  explicit Stages(const std::function<bool(TrainStage, double)>& progress) : progress_(progress) {}

  /// Sets the current stage.
  void begin(TrainStage stage) {
    if (ended_) return;
    stage_ = stage;
    at(0.0);
  }
  /// Reports the done part of the stage, in [0, 1]. False means end.
  bool at(double done) {
    if (ended_) return false;
    if (!progress_) return true;
    const std::lock_guard lock(mutex_);
    const auto [from, to] = part_of_work(stage_);
    done_ = std::max(done_, from + (to - from) * std::clamp(done, 0.0, 1.0));
    if (!ended_ && !progress_(stage_, done_)) ended_ = true;
    return !ended_;
  }
  /// Reports that all is done, unless training was ended before. It cannot be ended here any more.
  void complete() {
    if (!ended_ && progress_) progress_(stage_, 1.0);
  }
  [[nodiscard]] bool ended() const { return ended_; }
  [[nodiscard]] TrainStage stage() const { return stage_; }

 private:
  const std::function<bool(TrainStage, double)>& progress_;
  TrainStage stage_ = TrainStage::places;
  double done_ = 0.0;  ///< of the whole work
  std::mutex mutex_;
  std::atomic<bool> ended_{false};
};

}  // namespace roam::training
