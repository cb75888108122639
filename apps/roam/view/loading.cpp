#include "view/loading.h"

#include <exception>
#include <new>
#include <utility>

#include "roam/error.h"

namespace roam::app {

Loading::Loading(std::function<void()> load) : load_(std::move(load)), thread_([this] { run(); }) {}

Loading::~Loading() {
  cancel();
  thread_.join();
}

LoadState Loading::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void Loading::tell(LoadState::Phase phase, double share, std::uint64_t triangles) {
  const auto now = std::chrono::steady_clock::now();
  const std::lock_guard lock(mutex_);
  if (phase != state_.phase || state_.share <= 0.0) {
    phase_start_ = now;
    share_start_ = share;
  }
  state_.phase = phase;
  state_.share = share;
  state_.triangles = triangles;
  const double seconds = std::chrono::duration<double>(now - phase_start_).count();
  // Earlier estimates are guesses that confuse, and what follows reading takes a time that reading does not tell.
  constexpr double least_seconds = 1.0;
  constexpr double least_share = 0.02;
  // A build that goes on has not done its first share now.
  const double done = share - share_start_;
  const bool is_known = phase == LoadState::Phase::indexing && seconds > least_seconds && done > least_share;
  state_.seconds_left = is_known && share < 1.0 ? seconds * (1.0 - share) / done : -1.0;
}

void Loading::fail(const Error& error) {
  const std::lock_guard lock(mutex_);
  state_.error = error;
  state_.phase = LoadState::Phase::failed;
}

void Loading::run() {
  try {
    try {
      load_();
      return;
    } catch (const Cancelled&) {
      fail(Error("cancelled"));
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const Error& error) {
      fail(error);
    } catch (const std::exception& error) {
      fail(Error(error.what()));
    }
  } catch (const std::bad_alloc&) {
    with_state([&](LoadState& state) { state.phase = LoadState::Phase::failed; });
  }
}

}  // namespace roam::app
