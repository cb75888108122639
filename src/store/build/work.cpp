#include "store/build/work.h"

#include <fmt/format.h>
#include <tbb/info.h>

#include <algorithm>

namespace roam::store {
namespace {

constexpr std::uint64_t kMiB = 1u << 20;
/// The program itself, its libraries, and freed memory that the allocator keeps.
constexpr std::uint64_t program_bytes = 48 * kMiB;
/// A run in the worst case, when no triangle shares a vertex, and the memory for sorting it.
constexpr std::uint64_t run_bytes = 64 * kMiB;
/// A shard: its triangles, their sources and keys, and its tiles.
constexpr std::uint64_t shard_bytes = 136 * kMiB;
/// A tile under construction.
constexpr std::uint64_t tile_bytes_at_work = 8 * kMiB;
/// The memory of a reader if several read at once.
constexpr std::uint64_t reader_bytes = 160 * kMiB;
/// The least memory for sorting while reading.
constexpr std::uint64_t plenty = 512 * kMiB;

constexpr auto period = std::chrono::milliseconds(100);

int threads_of(const StoreBuildOptions& options) {
  const int cores = tbb::info::default_concurrency();
  const int wished = options.threads > 0 ? std::min(options.threads, cores) : cores;
  const std::uint64_t rest = options.memory - std::min(options.memory, program_bytes + shard_bytes);
  return std::clamp(static_cast<int>(std::min<std::uint64_t>(rest / tile_bytes_at_work, 1024)), 1, wished);
}

const StoreBuildOptions& checked(const StoreBuildOptions& options) {
  if (options.memory < StoreBuildOptions::least_memory) {
    throw Error(fmt::format("a build needs at least {} MiB of memory, not {}", StoreBuildOptions::least_memory / kMiB,
                            options.memory / kMiB));
  }
  if (options.threads < 0) throw Error("the number of threads is negative");
  if (options.output.empty()) throw Error("a build needs the name of a folder for its output");
  return options;
}

}  // namespace

Work::Work(const StoreBuildOptions& o) : options(checked(o)), store(o.output), arena(threads_of(o)) {}

int Work::readers(std::size_t parts) const {
  const std::uint64_t fit = (options.memory - program_bytes) / (run_bytes + reader_bytes);
  return static_cast<int>(
      std::clamp<std::uint64_t>(std::min<std::uint64_t>(fit, static_cast<std::uint64_t>(arena.max_concurrency())), 1,
                                std::max<std::uint64_t>(1, parts)));
}

std::uint64_t Work::reader_memory(int readers) const {
  const std::uint64_t runs = sorts_beside_reading(readers) ? 2 * run_bytes : run_bytes;
  return (options.memory - program_bytes) / static_cast<std::uint64_t>(readers) - runs;
}

bool Work::sorts_beside_reading(int readers) const { return readers == 1 && options.memory >= plenty; }

void Work::begin(Step step, std::uint64_t bytes_total, std::uint64_t triangles_total) {
  {
    const std::lock_guard lock(mutex_);
    step_ = step;
    bytes_total_ = bytes_total;
    triangles_total_ = triangles_total;
    bytes_ = 0;
    triangles_ = 0;
    next_ = {};
  }
  tick();
}

void Work::tick() {
  if (!options.progress) return;
  if (cancelled_) throw Cancelled();
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + period;
  if (!options.progress({step_, bytes_, bytes_total_, triangles_, triangles_total_, written_})) {
    cancelled_ = true;
    throw Cancelled();
  }
}

}  // namespace roam::store
