#pragma once
/// \file
/// Frees large things beside the frames.

#include <future>
#include <memory>
#include <mutex>
#include <utility>

namespace roam::app {

/// A thread that frees what takes longer than a frame: gigabytes, or a pager, whose last read must end. From any
/// thread. The destructor waits until all is freed.
class Freeing {
 public:
  /// `what` for many owners: whoever drops it last does not wait, `freeing` frees it.
  template <class T>
  static std::shared_ptr<T> later(const std::shared_ptr<Freeing>& freeing, std::shared_ptr<T> what) {
    if (what == nullptr) return nullptr;
    T* const at = what.get();
    return {at, [freeing, what = std::move(what)](T* /*same*/) mutable { freeing->free(std::move(what)); }};
  }

 private:
  void free(std::shared_ptr<const void> what);

  std::mutex mutex_;
  std::future<void> last_;  ///< waits for those before it
};

}  // namespace roam::app
