#include "view/loading.h"

#include <exception>
#include <new>
#include <string>
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

void Loading::run() {
  std::string error;
  try {
    load_();
    return;
  } catch (const Cancelled&) {
    error = "cancelled";
  } catch (const std::bad_alloc&) {
    error = "out of memory; take a smaller scene or a machine with more memory";
  } catch (const std::exception& e) {
    error = e.what();
  }
  with_state([&](LoadState& state) {
    state.phase = LoadState::Phase::failed;
    state.error = error;
  });
}

}  // namespace roam::app
