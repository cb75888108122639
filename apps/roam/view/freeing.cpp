#include "view/freeing.h"

#include <system_error>

namespace roam::app {

void Freeing::free(std::shared_ptr<const void> what) {
  const std::scoped_lock lock(mutex_);
  try {
    last_ = std::async(std::launch::async, [before = std::move(last_), what = std::move(what)]() mutable {
      what.reset();
      before = {};
    });
  } catch (const std::system_error&) {
    // There is no thread: it is freed by now, here.
    return;
  }
}

}  // namespace roam::app
