#pragma once
/// \file
/// The common state of all steps of a build: options, threads and progress.

#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <mutex>

#include "roam/store_build.h"
#include "store/folder.h"

namespace roam::store {

/// Adds its lifetime to `seconds`.
class Timer {
 public:
  explicit Timer(double& seconds) : seconds_(seconds) {}
  ~Timer() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class Work {
 public:
  using Step = StoreBuildProgress::Step;

  /// Throws roam::Error for options out of range.
  explicit Work(const StoreBuildOptions& options);

  const StoreBuildOptions& options;
  Folder store;  ///< held while building
  tbb::task_arena arena;

  /// How many of `parts` may be read at once.
  [[nodiscard]] int readers(std::size_t parts) const;
  /// The memory for each of `readers` imports with its reader process.
  [[nodiscard]] std::uint64_t reader_memory(int readers) const;
  /// Whether a run may be sorted while the next one is filled.
  [[nodiscard]] bool sorts_beside_reading(int readers) const;

  // Progress. Any thread may report it. If the caller's function returns false, one of these calls throws
  // roam::Cancelled.
  void begin(Step step, std::uint64_t bytes_total, std::uint64_t triangles_total);
  void add_bytes(std::uint64_t count) { bytes_ += count; }
  void add_triangles(std::uint64_t count) { triangles_ += count; }
  void add_written(std::uint64_t bytes) { written_ += bytes; }
  void tick();

  std::mutex large_records;  ///< held by the thread that reads one

 private:
  using Clock = std::chrono::steady_clock;

  Step step_ = Step::read;
  std::uint64_t bytes_total_ = 0, triangles_total_ = 0;
  std::atomic<std::uint64_t> bytes_{0}, triangles_{0}, written_{0};
  std::atomic<bool> cancelled_{false};
  std::mutex mutex_;
  Clock::time_point next_;
};

}  // namespace roam::store
