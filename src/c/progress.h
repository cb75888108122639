#pragma once
/// \file
/// Progress: calls a roam_progress, from one thread at a time and not too often.

#include <atomic>
#include <chrono>
#include <mutex>

#include "roam/error.h"
#include "roam/roam.h"

namespace roam::c {

class Progress {
 public:
  Progress(roam_progress call, void* data) : call_(call), data_(data) {}

  /// Whether the work goes on. Any thread may call it, as often as it likes.
  bool goes_on(double done) {
    if (call_ == nullptr) return true;
    if (const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock); lock.owns_lock() && !cancelled_) {
      const auto now = Clock::now();
      if (now - last_ >= between_calls) {
        last_ = now;
        if (call_(done, data_) != 0) cancelled_ = true;
      }
    }
    return !cancelled_;
  }
  void check(double done) {
    if (!goes_on(done)) throw Cancelled();
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds between_calls{10};

  roam_progress call_;
  void* data_;
  std::mutex mutex_;
  Clock::time_point last_{};
  std::atomic<bool> cancelled_{false};
};

}  // namespace roam::c
