#pragma once
/// \file
/// Where the thread of the body and the loading threads meet: a lock that is held for microseconds, and that the body's
/// thread only ever tries.

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

/// A queue in memory that is taken once.
template <class T>
class Queue {
 public:
  explicit Queue(std::size_t capacity) : items_(capacity) {}

  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t room() const { return items_.size() - size_; }
  /// Only where there is room.
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

/// What update() is to do.
struct Message {
  enum class Kind : std::uint8_t { come, go, failed };
  Kind kind = Kind::come;
  PagedItem item;
  std::uint32_t unit = 0;  ///< of a tile that comes
  PageInMemory page;       ///< that comes
};

/// What became of a item that was to go.
struct Gone {
  PagedItem item;
  bool kept = false;  ///< too near to the body
};

struct Handover {
  static constexpr std::size_t capacity = 1024, most_loaders = 16;

  std::mutex mutex;
  TrackedBody tracked;
  std::uint64_t told = 0;  ///< how often update() told of a body
  Queue<Message> messages{capacity};
  Queue<Gone> gone{capacity};
  PagerStats stats;      ///< but for last_failure
  double latency = 0.0;  ///< seconds from the beginning of a read until the item is ready: the worst of late
  std::array<Clock::time_point, most_loaders> reading_since{};  ///< by loading thread; 0 where it does not read
  struct {
    PagedItem item;
    Box box;
    const char* why = nullptr;  ///< null: none yet
  } last_failure;
};

}  // namespace roam::paging
