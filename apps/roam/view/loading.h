#pragma once
/// \file
/// The life of a thread that loads something.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

#include "view/status.h"

namespace roam::app {

/// Runs `load` in a thread of its own and keeps how far it is. What `load` throws becomes the state's error. Let it be
/// the last member of its owner: it ends first, and `load` may use all others.
class Loading {
 public:
  explicit Loading(std::function<void()> load);
  /// Cancels, and waits for the end.
  ~Loading();
  Loading(const Loading&) = delete;
  Loading& operator=(const Loading&) = delete;

  /// Lets `load` come to its end; does not wait for that.
  void cancel() { cancelled_ = true; }
  /// For `load` to ask now and then: whether it is to go on.
  [[nodiscard]] bool wanted() const { return !cancelled_; }
  /// For `load` to say how far it is: `share` in [0, 1] of this phase, how many triangles so far. How long the phase
  /// will take follows from that.
  void tell(LoadState::Phase phase, double share, std::uint64_t triangles);
  /// How far it is; from any thread.
  [[nodiscard]] LoadState state() const;
  /// Calls `access` with the state and returns what it returns, while no other thread does either.
  template <typename Access>
  auto with_state(const Access& access) {
    const std::lock_guard lock(mutex_);
    return access(state_);
  }

 private:
  void run();

  std::function<void()> load_;
  std::atomic<bool> cancelled_ = false;
  mutable std::mutex mutex_;
  LoadState state_;
  std::chrono::steady_clock::time_point phase_start_ = std::chrono::steady_clock::now();
  std::thread thread_;
};

}  // namespace roam::app
