#include "store/build/shard_triangles.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <tuple>
#include <utility>

#include "roam/error.h"
#include "store/build/layout.h"
#include "store/build/run.h"

namespace roam::store {
namespace {

/// The blocks that may hold triangles of the stretch: a range of each run, in the order of the scene.
class Blocks {
 public:
  Blocks(Work& work, const Plan& plan, const Stretch& stretch)
      : work_(work), plan_(plan), first_(stretch.cells.front().key), last_(stretch.cells.back().last()) {
    for (const std::uint32_t p : stretch.parts) {
      const PartRecord& record = plan_.parts[p];
      if (!record.has_runs) {
        throw Error::at(record.info.name,
                        fmt::format("the plan does not hold the triangles of {}; plan again", record.info.name));
      }
      for (std::size_t r = 0; r < record.runs.size(); ++r) {
        if (record.runs[r].last >= first_ && record.runs[r].first <= last_) runs_.push_back({p, r});
      }
    }
  }

  [[nodiscard]] bool holds(CurveKey key) const { return key >= first_ && key <= last_; }
  [[nodiscard]] std::size_t runs() const { return runs_.size(); }

  /// Calls f(index of the run, run, range of its blocks) for each run, from many threads.
  template <class F>
  void for_each_run(F&& f) const {
    tbb::parallel_for(std::size_t{0}, runs_.size(), [&](std::size_t i) {
      const PartRecord& record = plan_.parts[runs_[i].part];
      const std::size_t number = runs_[i].run;
      const RunReader run(work_.store, run_file(record.id, number), record.runs[number].hash);
      f(i, run, run.blocks(first_, last_));
    });
  }
  /// Calls f(block, part, index of the run, index of the block in the run's range), from many threads.
  template <class F>
  void for_each(F&& f) const {
    for_each_run([&](std::size_t i, const RunReader& run, const RunReader::Range& range) {
      tbb::parallel_for(range.begin, range.end, [&](std::size_t b) {
        work_.tick();
        static thread_local RunBlock block;  // keeps its memory for the next block
        run.read(b, block);
        f(block, runs_[i].part, i, b - range.begin);
      });
    });
  }

 private:
  struct RunOf {
    std::uint32_t part;
    std::size_t run;
  };

  Work& work_;
  const Plan& plan_;
  CurveKey first_, last_;
  std::vector<RunOf> runs_;
};

/// For a smallest cell that fills several shards: the number of its triangles before each block, by part and number.
class Ranks {
 public:
  explicit Ranks(const Blocks& blocks) : before_(blocks.runs()) {
    blocks.for_each_run([&](std::size_t i, const RunReader&, const RunReader::Range& range) {
      before_[i].resize(range.end - range.begin);
    });
    blocks.for_each([&](const RunBlock& block, std::uint32_t, std::size_t run, std::size_t number) {
      before_[run][number] =
          static_cast<std::uint64_t>(std::count_if(block.triangles.begin(), block.triangles.end(),
                                                   [&](const Triangle& t) { return blocks.holds(place_of(t).key); }));
    });
    std::uint64_t sum = 0;
    for (auto& run : before_) {
      for (std::uint64_t& count : run) count = std::exchange(sum, sum + count);
    }
  }
  [[nodiscard]] std::uint64_t before(std::size_t run, std::size_t block) const { return before_[run][block]; }

 private:
  std::vector<std::vector<std::uint64_t>> before_;
};

auto coordinates(const Triangle& t) {
  return std::tuple(t[0].x, t[0].y, t[0].z, t[1].x, t[1].y, t[1].z, t[2].x, t[2].y, t[2].z);
}

}  // namespace

ShardTriangles read_shard(Work& work, const Plan& plan, const Stretch& stretch) {
  const Blocks blocks(work, plan, stretch);
  std::optional<Ranks> ranks;
  if (stretch.cells.size() == 1 && stretch.cells.front().bits == 0) ranks.emplace(blocks);

  const auto count = static_cast<std::size_t>(stretch.triangles);
  ShardTriangles out(count);
  std::atomic<std::size_t> filled{0};
  blocks.for_each([&](const RunBlock& block, std::uint32_t part, std::size_t run, std::size_t number) {
    std::vector<std::pair<std::uint32_t, Place>> chosen;
    chosen.reserve(block.triangles.size());
    std::uint64_t rank = ranks ? ranks->before(run, number) : 0;
    for (std::size_t i = 0; i < block.triangles.size(); ++i) {
      const Place place = place_of(block.triangles[i]);
      if (!blocks.holds(place.key)) continue;
      // Below `skip` the difference wraps around to a value larger than any count.
      if (ranks && rank++ - stretch.skip >= stretch.triangles) continue;
      chosen.push_back({static_cast<std::uint32_t>(i), place});
    }
    std::size_t at = filled.fetch_add(chosen.size());
    for (const auto& [i, place] : chosen) {
      if (at >= count) break;
      out.triangles[at] = block.triangles[i];
      out.sources[at] = {block.numbers[i], part};
      out.items[at] = {place.key, place.reach, static_cast<std::uint32_t>(at)};
      ++at;
    }
  });
  if (filled != count) {
    throw Error(
        fmt::format("the runs of a shard hold {} triangles, and the plan says {}; plan again", filled.load(), count));
  }
  tbb::parallel_sort(out.items.begin(), out.items.end(), [&](const ShardItem& a, const ShardItem& b) {
    if (a.key != b.key) return a.key < b.key;
    const auto key_of = [&](std::uint32_t i) {
      const auto& s = out.sources[i];
      return std::tuple_cat(coordinates(out.triangles[i]), std::tuple(s.part, s.number));
    };
    return key_of(a.triangle) < key_of(b.triangle);
  });
  return out;
}

}  // namespace roam::store
