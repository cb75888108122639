#include "store/read_ahead.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace roam::store {

ReadAhead::~ReadAhead() {
  ending_.request_stop();
  threads_.clear();  // waits for them
}

bool ReadAhead::has_room() const {
  const int at_once = bytes_.best_at_once();
  return at_once > 1 && reads_.size() < static_cast<std::size_t>(depth * at_once);
}

void ReadAhead::begin(const CheckedRange& range) {
  if (!has_room()) return;
  const std::lock_guard lock(mutex_);
  reads_.push_back({.range = range});
  // A thread that cannot be started is one fewer; take() reads by itself.
  try {
    if (threads_.size() < reads_.size()) threads_.emplace_back([this] { run(); });
  } catch (const std::system_error&) {
  }
  changed_.notify_all();
}

ReadAhead::Result ReadAhead::take(const CheckedRange& range, const std::stop_token& stop) {
  std::list<Read> taken;
  {
    std::unique_lock lock(mutex_);
    const auto at = std::find_if(reads_.begin(), reads_.end(), [&](const Read& r) { return r.range == range; });
    if (at != reads_.end()) {
      if (at->begun) changed_.wait(lock, [&] { return at->done; });
      taken.splice(taken.begin(), reads_, at);
    }
  }
  if (taken.empty()) taken.push_back({.range = range});
  Read& one = taken.front();
  if (!one.done) read(one, stop);
  if (one.thrown) std::rethrow_exception(one.thrown);
  return std::move(one.result);
}

void ReadAhead::read(Read& one, const std::stop_token& stop) const {
  try {
    one.result.bytes.resize(static_cast<std::size_t>(one.range.bytes));
    const CheckedRange& r = one.range;
    one.result.problem = r.hash ? bytes_.read_checked(r.file, r.offset, one.result.bytes, *r.hash, stop)
                                : bytes_.read(r.file, r.offset, one.result.bytes, stop);
  } catch (...) {
    one.thrown = std::current_exception();
  }
}

void ReadAhead::run() {
  const std::stop_token stop = ending_.get_token();
  std::unique_lock lock(mutex_);
  for (;;) {
    auto next = reads_.end();
    changed_.wait(lock, stop, [&] {
      next = std::find_if(reads_.begin(), reads_.end(), [](const Read& r) { return !r.begun; });
      return next != reads_.end();
    });
    if (stop.stop_requested()) return;
    next->begun = true;
    lock.unlock();
    read(*next, stop);
    lock.lock();
    next->done = true;
    changed_.notify_all();
  }
}

}  // namespace roam::store
