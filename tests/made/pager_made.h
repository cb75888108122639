#pragma once
/// \file
/// Shared by the tests of the pager: loading all of a store, and files that are slow, wrong or missing.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <memory>
#include <mutex>
#include <set>
#include <thread>

#include "roam/pager.h"
#include "store_made.h"

namespace made {

/// Updates until `done`, at most half a minute. Returns whether it is done.
template <class Done>
bool update_until(roam::Pager& pager, const roam::Body& body, const roam::Vec3& place, const Done& done,
                  const roam::Vec3& velocity = roam::Vec3(0.0)) {
  for (int i = 0; i < 120'000; ++i) {
    (void)pager.update(body, place, velocity);
    if (done()) return true;
    std::this_thread::sleep_for(std::chrono::microseconds(250));
  }
  return false;
}

/// Loads everything; memory must suffice.
inline void load_all(roam::Pager& pager) {
  const auto tiles = pager.store().info().tiles;
  ASSERT_TRUE(update_until(pager, {0.3, 0.0}, pager.bounds().center(), [&] { return pager.stats().tiles == tiles; }));
}

/// The files of a store, with adjustable faults.
class TroubledBytes : public roam::store::StoreBytes {
 public:
  explicit TroubledBytes(const std::filesystem::path& folder) : files_(roam::store::files_of(folder)) {}

  /// How many of every thousand reads of packs fail, are too short, or have a flipped bit.
  std::atomic<int> errors{0}, short_reads{0}, flips{0};
  std::atomic<int> delay_us{0};
  std::atomic<std::uint64_t> reads{0};
  /// The reason of errors.
  const char* reason = "the disk reports an input/output error";
  /// How many of every thousand offsets the web server does not have.
  std::atomic<int> lost{0};
  /// Offsets of reads without faults. Set it before the first read.
  std::set<std::uint64_t> spared;

  /// From now on reads wait until they are released.
  void hold() {
    const std::lock_guard lock(mutex_);
    held_ = true;
  }
  void let_go() {
    const std::lock_guard lock(mutex_);
    held_ = false;
    changed_.notify_all();
  }
  [[nodiscard]] int waiting() const { return waiting_; }

  std::vector<std::byte> whole(const std::string& file, std::uint64_t limit) override {
    return files_->whole(file, limit);
  }
  const char* read(const std::string& file, std::uint64_t offset, std::span<std::byte> out,
                   const std::stop_token& /*stop*/) override {
    const std::uint64_t n = ++reads;
    {
      std::unique_lock lock(mutex_);
      ++waiting_;
      changed_.wait(lock, [this] { return !held_; });
      --waiting_;
    }
    if (const int us = delay_us; us > 0) std::this_thread::sleep_for(std::chrono::microseconds(us));
    std::uint64_t chance = (n * 0x9E3779B97F4A7C15ULL) >> 20;
    const auto strikes = [&](int of_thousand) {
      chance = chance * 6364136223846793005ULL + 1442695040888963407ULL;
      return static_cast<int>((chance >> 33) % 1000) < of_thousand;
    };
    if (spared.contains(offset)) return files_->read(file, offset, out);
    if (static_cast<int>((offset * 0x9E3779B97F4A7C15ULL >> 33) % 1000) < lost) {
      return "the web server has no such file (status 404 or 410)";
    }
    if (strikes(errors)) return reason;
    if (const char* problem = files_->read(file, offset, out)) return problem;
    if (strikes(short_reads)) std::memset(out.data() + out.size() / 2, 0, out.size() - out.size() / 2);
    if (strikes(flips)) out[(chance >> 7) % out.size()] ^= std::byte{1} << (chance % 8);
    return nullptr;
  }

 private:
  std::shared_ptr<roam::store::StoreBytes> files_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool held_ = false;
  std::atomic<int> waiting_{0};
};

}  // namespace made
