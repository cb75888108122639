#pragma once
/// \file
/// A loading thread with its progress and its cancellation.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

#include "view/status.h"

namespace roam::app {

/// Runs `load` in a thread of its own and keeps its progress. An exception of `load` becomes the state's error. Make it
/// the last member of its owner: its destructor then runs first, and `load` may use all other members.
class Loading {
 public:
  explicit Loading(std::function<void()> load);
  /// Cancels, and waits for the thread.
  ~Loading();
  Loading(const Loading&) = delete;
  Loading& operator=(const Loading&) = delete;

  /// Cancels without waiting.
  void cancel() { cancelled_ = true; }
  /// For `load` to poll: false after cancel().
  [[nodiscard]] bool wanted() const { return !cancelled_; }
  /// Sets the progress, from within `load`. `share`: of this phase, in [0, 1]. `triangles`: so far. Estimates the time
  /// left while indexing, the last phase that takes long, from the rate in this phase.
  void tell(LoadState::Phase phase, double share, std::uint64_t triangles);
  /// Progress; from any thread.
  [[nodiscard]] LoadState state() const;
  /// Calls `access` with the state under the lock, and returns its result.
  template <typename Access>
  auto with_state(const Access& access) {
    const std::lock_guard lock(mutex_);
    return access(state_);
  }

 private:
  void run();
  void fail(const Error& error);

  std::function<void()> load_;
  std::atomic<bool> cancelled_ = false;
  mutable std::mutex mutex_;
  LoadState state_;
  std::chrono::steady_clock::time_point phase_start_ = std::chrono::steady_clock::now();
  double share_start_ = 0.0;  ///< of the phase
  std::thread thread_;
};

}  // namespace roam::app
