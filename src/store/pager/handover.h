#pragma once
/// \file
/// Data that the body's thread and the loading threads exchange. Its lock is held for microseconds, and the body's
/// thread only tries it.

#include <array>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <vector>

#include "roam/pager.h"
#include "store/pager/paged_item.h"
#include "store/pager/residents.h"
#include "store/pager/tracked_body.h"

namespace roam::paging {

using Clock = std::chrono::steady_clock;

/// A queue of fixed capacity, allocated once.
template <class T>
class Queue {
 public:
  explicit Queue(std::size_t capacity) : items_(capacity) {}

  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t room() const { return items_.size() - size_; }
  /// Requires room() > 0.
  void push(const T& item) { items_[(first_ + size_++) % items_.size()] = item; }
  T pop() {
    const T item = items_[first_];
    first_ = (first_ + 1) % items_.size();
    --size_;
    return item;
  }

 private:
  std::vector<T> items_;
  std::size_t first_ = 0, size_ = 0;
};

/// A change for update() to make.
struct Message {
  enum class Kind : std::uint8_t { come, go, failed };
  Kind kind = Kind::come;
  PagedItem item;
  std::uint32_t unit = 0;  ///< of a tile, for `come`
  PageInMemory page{};     ///< for `come`
};

/// The result of a request to evict an item.
struct Gone {
  PagedItem item;
  bool kept = false;  ///< not evicted: too near to the body
};

struct Handover {
  static constexpr std::size_t capacity = 1024, most_loaders = 16;

  std::mutex mutex;
  TrackedBody tracked;
  std::uint64_t told = 0;     ///< number of times that update() has set `tracked`
  std::uint64_t full_at = 0;  ///< `told` when memory last was full, and nothing on its way
  Queue<Message> messages{capacity};
  Queue<Gone> gone{capacity};
  PagerStats stats;      ///< all except last_failure
  double latency = 0.0;  ///< seconds from the start of a read until the item is ready: a recent maximum
  std::array<Clock::time_point, most_loaders> reading_since{};  ///< by loading thread; 0 if it is not reading
  struct {
    PagedItem item;
    Box box;
    const char* why = nullptr;  ///< null: no failure yet
  } last_failure;
};

}  // namespace roam::paging
