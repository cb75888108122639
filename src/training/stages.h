#pragma once
/// \file
/// What training tells while it works, and how it is told to end.

#include <atomic>
#include <functional>
#include <mutex>

#include "roam/train.h"

namespace roam::training {

/// Passes progress on, one thread at a time, and remembers that it was told to stop: everything asked afterwards ends
/// at once. Safe to call from any thread, but for begin().
class Stages {
 public:
  explicit Stages(const std::function<bool(TrainStage, double)>& progress) : progress_(progress) {}

  /// What is being done from now on.
  void begin(TrainStage stage) {
    if (ended_) return;
    stage_ = stage;
    at(0.0);
  }
  /// So much of it is done. False: end.
  bool at(double done) {
    if (ended_) return false;
    if (!progress_) return true;
    const std::lock_guard lock(mutex_);
    if (!ended_ && !progress_(stage_, done)) ended_ = true;
    return !ended_;
  }
  [[nodiscard]] bool ended() const { return ended_; }
  [[nodiscard]] TrainStage stage() const { return stage_; }

 private:
  const std::function<bool(TrainStage, double)>& progress_;
  TrainStage stage_ = TrainStage::places;
  std::mutex mutex_;
  std::atomic<bool> ended_{false};
};

}  // namespace roam::training
