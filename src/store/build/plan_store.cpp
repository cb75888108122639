// The first step of a build: reads the changed parts and decides the shards.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <thread>

#include "roam/error.h"
#include "store/build/fingerprint.h"
#include "store/build/layout.h"
#include "store/build/merge.h"
#include "store/build/plan.h"
#include "store/build/run.h"
#include "store/files.h"

namespace roam::store {
namespace {

class Planner {
 public:
  Planner(Work& work, const std::set<std::string>& damaged, StoreBuildReport& report)
      : work_(work), damaged_(damaged), report_(report), sources_(work.store, work.options.key, work.options.import) {}

  std::optional<Plan> run() {
    work_.begin(Work::Step::read, 0, 0);
    in_force_ = manifest_in_force(work_.store);
    plan_.options = text_of(work_.options.import);
    if (plan_.options.size() > longest_options) {
      throw Error(
          fmt::format("the patterns to ignore and the allowed folders are longer than {} kB together; name fewer",
                      longest_options >> 10));
    }
    ImportOptions listing = work_.options.import;
    listing.memory_limit = work_.options.memory;
    parts_ = scene_parts(work_.options.scene, listing);
    plan_.lossless = work_.options.lossless;
    take_records();
    report_.parts = parts_.size();
    if (unchanged()) {
      sources_.save();
      return {};
    }
    read(unknown_);
    do {
      work_.begin(Work::Step::plan, 0, 0);
      limit_references();
      lay_out();
    } while (read(needed()));
    sources_.save();
    return std::move(plan_);
  }

 private:
  /// A part as it was read, and the files that decide whether it has changed since.
  struct Earlier {
    std::size_t part;
    PartRecord record;
    SourcePart sources;
  };

  /// The earlier states of all parts, by part: from the scratch folder, then from the store in force.
  std::vector<Earlier> earlier_parts() {
    std::map<std::string, std::size_t> before;
    std::vector<std::vector<std::string>> notes;
    std::uint64_t references = 0;
    if (in_force_) {
      for (std::size_t i = 0; i < in_force_->parts.size(); ++i) before[in_force_->parts[i].name] = i;
      for (const PartInfo& part : in_force_->parts) references += references_cost(part.references);
      notes = notes_by_part(*in_force_);
    }
    std::vector<Earlier> earlier;
    const auto add = [&](std::size_t i, PartRecord&& record) {
      if (std::optional<SourcePart> sources = sources_.with_references(parts_[i], record.info.references)) {
        earlier.push_back({i, std::move(record), std::move(*sources)});
      }
    };
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (std::optional<PartRecord> record = find_record(work_, parts_[i].name)) add(i, std::move(*record));
      const auto old = before.find(parts_[i].name);
      if (old == before.end() || references > most_reference_bytes) continue;
      add(i, {in_force_->parts[old->second], "", {}, false, notes[old->second]});
    }
    return earlier;
  }

  /// Collects the known facts of each part without reading it.
  void take_records() {
    std::vector<Earlier> earlier = earlier_parts();
    std::vector<SourcePart> sources(parts_.begin(), parts_.end());
    for (const Earlier& part : earlier) sources.push_back(part.sources);
    look(sources);
    auto next = earlier.begin();
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      // An interrupted reading and its repetition have the same id, so that the latter replaces the runs.
      const SourcePart known = next != earlier.end() && next->part == i ? next->sources : SourcePart(parts_[i]);
      PartRecord record;
      record.info.name = parts_[i].name;
      record.id = record_id(parts_[i].name, sources_.fingerprint(known, plan_.options));
      bool found = false;
      for (; next != earlier.end() && next->part == i; ++next) {
        const PartInfo& info = next->record.info;
        if (found || info.fingerprint != sources_.fingerprint(next->sources, plan_.options) || !is_there(info))
          continue;
        found = true;
        if (next->record.id.empty()) next->record.id = record_id(info.name, info.fingerprint);
        record = std::move(next->record);
      }
      if (!found) unknown_.push_back(i);
      plan_.parts.push_back(std::move(record));
    }
  }

  void look(const std::vector<SourcePart>& parts) {
    work_.arena.execute([&] { sources_.look(parts, [&] { work_.tick(); }); });
  }

  [[nodiscard]] bool is_there(const PartInfo& info) const {
    return !damaged_.contains(info.file) && size_of(work_.store, part_file(info.file)) == info.bytes;
  }
  [[nodiscard]] bool is_there(const ShardInfo& shard) const {
    return !damaged_.contains(shard.pack) && size_of(work_.store, pack_file(shard.pack)) == shard.bytes;
  }

  [[nodiscard]] bool unchanged() const {
    if (!in_force_ || in_force_->lossless != plan_.lossless || in_force_->options != plan_.options ||
        in_force_->format != format_version || !unknown_.empty() || in_force_->parts.size() != plan_.parts.size()) {
      return false;
    }
    for (std::size_t i = 0; i < plan_.parts.size(); ++i) {
      const PartInfo &now = plan_.parts[i].info, &then = in_force_->parts[i];
      if (now.name != then.name || now.fingerprint != then.fingerprint || now.file != then.file) return false;
    }
    return std::all_of(in_force_->shards.begin(), in_force_->shards.end(),
                       [&](const ShardInfo& shard) { return is_there(shard); });
  }

  /// Reads these parts, several at once if memory allows. Returns false if there are none.
  bool read(const std::vector<std::size_t>& numbers) {
    if (numbers.empty()) return false;
    std::uint64_t bytes = 0;
    for (const std::size_t i : numbers) bytes += parts_[i].bytes;
    work_.begin(Work::Step::read, bytes, 0);
    const Timer timer(report_.read_seconds);
    const int readers = work_.readers(numbers.size());
    std::vector<std::exception_ptr> failures(numbers.size());
    std::atomic<std::size_t> next{0};
    std::atomic<bool> ends{false};
    const auto read_some = [&] {
      for (std::size_t n; !ends && (n = next++) < numbers.size();) {
        try {
          read_one(numbers[n], readers);
        } catch (...) {
          failures[n] = std::current_exception();
          ends = readers == 1 || is_cancelled(failures[n]);
        }
      }
    };
    {
      std::vector<std::jthread> threads;
      for (int t = 1; t < readers; ++t) threads.emplace_back(read_some);
      read_some();
    }
    for (const std::exception_ptr& failure : failures) {
      if (failure && (readers == 1 || is_cancelled(failure))) std::rethrow_exception(failure);
    }
    for (std::size_t n = 0; n < numbers.size(); ++n) {
      if (failures[n]) read_one(numbers[n], 1);  // again, with all of the memory
    }
    report_.parts_read += numbers.size();
    return true;
  }

  void read_one(std::size_t i, int readers) {
    // A sixteenth of the memory for the names of files.
    LookUps look_ups(parts_[i], sources_.scope(parts_[i].path),
                     work_.options.memory / (16 * static_cast<std::uint64_t>(readers)));
    PartRecord record = read_part(work_, parts_[i], plan_.parts[i].id, readers, look_ups, budget_);
    SourcePart sources(parts_[i]);
    for (const auto& [name, file] : look_ups.files()) {
      record.info.references.push_back(name);
      sources.references.emplace(name, file.file);
    }
    look({sources});
    sources_.check_unchanged(sources, look_ups);
    record.info.fingerprint = sources_.fingerprint(sources, plan_.options);
    if (!look_ups.are_all()) {
      record.info.fingerprint += fmt::format(" {:016x}", record.content);
      forget_references(record);
    }
    publish_record(work_, record);
    plan_.parts[i] = std::move(record);
  }

  /// Gives a part whose references cannot be recorded a fingerprint that no list of files has: it is always read again.
  static void forget_references(PartRecord& record) {
    const std::string text = "roam part of unknown files\n" + record.info.fingerprint;
    record.info.fingerprint = sha256(std::as_bytes(std::span(text)));
    record.info.references.clear();
  }

  /// Keeps the references within the limit of a manifest.
  void limit_references() {
    std::uint64_t bytes = 0;
    for (PartRecord& part : plan_.parts) {
      const std::uint64_t cost = references_cost(part.info.references);
      if (cost > most_reference_bytes - bytes) {
        forget_references(part);
      } else {
        bytes += cost;
      }
    }
  }

  static bool is_cancelled(const std::exception_ptr& failure) {
    try {
      std::rethrow_exception(failure);
    } catch (const Cancelled&) {
      return true;
    } catch (...) {
      return false;
    }
  }

  /// Decides the shards as far as the parts' runs allow. `missing_` gets the parts that must be read first.
  void lay_out() {
    missing_.clear();
    std::map<std::string, std::vector<std::uint32_t>> parts_of;  // by file
    for (std::size_t i = 0; i < plan_.parts.size(); ++i) {
      parts_of[plan_.parts[i].info.file].push_back(static_cast<std::uint32_t>(i));
    }
    std::vector<PartCell> cells;
    std::uint64_t triangles = 0;
    for (const auto& [hash, parts] : parts_of) {
      const std::string file = part_file(hash);
      int bits = 0;
      PartVisitor visitor;
      visitor.counts = [&, &parts = parts](const PartCounts& counts) {
        bits = counts.cell_bits;
        if (counts.triangles > (most_triangles - triangles) / parts.size()) {
          throw Error::at((work_.store / file).string(),
                          fmt::format("{} counts more triangles than any scene has: verify the store, and repair it",
                                      (work_.store / file).string()));
        }
        triangles += counts.triangles * parts.size();
        if (counts.cells > (most_cells_of_plan() - std::min(most_cells_of_plan(), cells.size())) / parts.size()) {
          throw Error::at(work_.store.string(),
                          fmt::format("the parts of {} take more memory than there is to plan in; give --memory more",
                                      work_.store.string()));
        }
      };
      visitor.cell = [&, &parts = parts](const Cell& cell) {
        for (const std::uint32_t part : parts) cells.push_back({cell.key, cell.triangles, part, bits});
      };
      visitor.enough = [&] {
        work_.tick();
        return false;
      };
      const Descriptor opened = open_file(work_.store, file, O_RDONLY);
      if (!opened.is_open()) fail("read", work_.store, file, errno);
      visit_part(
          [&](std::span<std::byte> out) {
            const ssize_t got = again([&] { return ::read(opened.number(), out.data(), out.size()); });
            if (got < 0) fail("read", work_.store, file, errno);
            return static_cast<std::size_t>(got);
          },
          size_of(work_.store, file).value_or(0), file, visitor);
    }
    if (cells.empty()) {
      remove_results();
      throw Error("the scene holds no triangle");
    }
    std::vector<Stretch> stretches = divide(std::move(cells), [&](std::uint32_t part, const CurveCell& cell, int bits) {
      return refine(part, cell, bits);
    });
    plan_.shards.clear();
    if (!missing_.empty()) return;
    std::map<std::string, const ShardInfo*> before;
    if (in_force_) {
      for (const ShardInfo& shard : in_force_->shards) before[shard.key] = &shard;
    }
    for (Stretch& stretch : stretches) {
      PlannedShard shard;
      work_.tick();
      shard.key = key_of(stretch, plan_);
      shard.stretch = std::move(stretch);
      const auto old = before.find(shard.key);
      shard.in_force = old != before.end() && is_there(*old->second);
      plan_.shards.push_back(std::move(shard));
    }
  }

  /// The largest scene: some 100,000 shards.
  static constexpr std::uint64_t most_triangles = 1ull << 38;
  /// Half of the memory, for a list that grows by doubling.
  [[nodiscard]] std::size_t most_cells_of_plan() const {
    return static_cast<std::size_t>(work_.options.memory / (6 * sizeof(PartCell)));
  }

  /// If a scene cannot become a store, its results are removed.
  void remove_results() const {
    if (in_force_) return;
    remove_scratch(work_.store);
    for (const PartRecord& part : plan_.parts) remove_file(work_.store, part_file(part.info.file));
  }

  /// See Refine. Counts in the runs of the part. A part without runs goes into `missing_`, and counts as one triangle
  /// in one cell.
  std::vector<PartCell> refine(std::uint32_t part, const CurveCell& cell, int bits) {
    const PartRecord& record = plan_.parts[part];
    if (!record.has_runs) {
      missing_.insert(part);
      return {{cell.key, 1, part, bits}};
    }
    std::vector<std::uint64_t> counts(std::size_t{1} << (cell.bits - bits));
    RunBlock block;
    for (std::size_t r = 0; r < record.runs.size(); ++r) {
      if (record.runs[r].last < cell.key || cell.last() < record.runs[r].first) continue;
      const RunReader run(work_.store, run_file(record.id, r));
      const RunReader::Range range = run.blocks(cell.key, cell.last());
      for (std::size_t b = range.begin; b < range.end; ++b) {
        run.read(b, block);
        for (const Triangle& t : block.triangles) {
          const CurveKey key = place_of(t).key;
          if (key >= cell.key && key <= cell.last()) ++counts[static_cast<std::size_t>((key - cell.key) >> bits)];
        }
        work_.tick();
      }
    }
    std::vector<PartCell> out;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (counts[i] > 0) out.push_back({cell.key + (CurveKey{i} << bits), counts[i], part, bits});
    }
    return out;
  }

  /// The parts that must be read before the shards can be decided or built.
  [[nodiscard]] std::vector<std::size_t> needed() const {
    std::set<std::size_t> parts(missing_.begin(), missing_.end());
    for (const PlannedShard& shard : plan_.shards) {
      if (shard.in_force || built_shard(work_, shard.key)) continue;
      for (const std::uint32_t p : shard.stretch.parts) {
        if (!plan_.parts[p].has_runs) parts.insert(p);
      }
    }
    return {parts.begin(), parts.end()};
  }

  Work& work_;
  const std::set<std::string>& damaged_;
  StoreBuildReport& report_;
  Sources sources_;
  reader::SceneBudget budget_;
  std::optional<Manifest> in_force_;
  std::vector<ScenePart> parts_;
  std::vector<std::size_t> unknown_;  ///< parts that must be read in any case
  std::set<std::size_t> missing_;
  Plan plan_;
};

}  // namespace

std::optional<Plan> make_plan(Work& work, const std::set<std::string>& damaged, StoreBuildReport& report) {
  return Planner(work, damaged, report).run();
}

}  // namespace roam::store
