#include "view/freeing.h"

#include <exception>

namespace roam::app {

void Freeing::free(std::shared_ptr<const void> what) {
  const std::scoped_lock lock(mutex_);
  try {
    last_ = std::async(std::launch::async, [before = std::move(last_), what = std::move(what)]() mutable {
      what.reset();
      before = {};
    });
  } catch (const std::exception&) {
    // There is no thread, or no memory for one: it is freed by now, here.
    return;
  }
}

}  // namespace roam::app
