// The first step of a build: reads the changed parts and decides the shards.

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <string_view>

#include "roam/error.h"
#include "store/build/layout.h"
#include "store/build/merge.h"
#include "store/build/output_folder.h"
#include "store/build/part_cells.h"
#include "store/build/plan.h"
#include "store/build/scene_reader.h"
#include "store/files.h"

namespace roam::store {
namespace {

class Planner {
 public:
  Planner(Work& work, const std::set<std::string>& damaged, StoreBuildReport& report)
      : work_(work), damaged_(damaged), reader_(work, listed_parts(work), damaged, report, plan_.parts) {}

  std::optional<Plan> run() {
    in_force_ = manifest_in_force(work_);
    reader_.take_records(in_force_, reader_.all());
    remove_former_runs();
    plan_.options = reader_.options();
    plan_.lossless = work_.options.lossless;
    if (unchanged()) {
      reader_.save();
      return {};
    }
    reader_.read(reader_.unknown());
    do {
      work_.begin(Work::Step::plan, 0, 0);
      reader_.limit_references();
      lay_out();
    } while (reader_.read(needed()));
    remove_former_shards();
    reader_.save();
    return std::move(plan_);
  }

 private:
  /// Removes the runs of parts that are gone or have changed since a build that never ended. A share that is being
  /// read may be of another state of the scene: then all runs stay.
  void remove_former_runs() const {
    if (is_being_read(work_.store)) return;
    std::set<std::string_view> ids;
    for (const PartRecord& part : plan_.parts) ids.insert(part.id);
    for (const std::string& file : files_in(work_.store, "scratch/runs")) {
      const std::string_view id = id_of_run(file);
      if (!id.empty() && !ids.contains(id)) remove_file(work_.store, file);
    }
  }
  /// Removes the shards that are not of this plan but of a build that never ended, and their packs.
  void remove_former_shards() const {
    std::map<std::string, const PlannedShard*> planned;
    for (const PlannedShard& shard : plan_.shards) planned[shard_file(shard.key)] = &shard;
    std::vector<std::string> former;
    std::set<std::string> needed;
    for (const std::string& file : files_in(work_.store, "scratch/shards")) {
      work_.tick();
      if (!is_named_by_hash(file, ".json")) continue;
      if (!planned.contains(file)) {
        former.push_back(file);
      } else if (const auto shard = built_shard(work_, planned[file]->key)) {
        needed.insert(pack_file(shard->pack));
      }
    }
    if (former.empty()) return;
    try {
      needed.merge(files_of_manifests(work_.store, work_.options.memory));
    } catch (const Error&) {
      return;  // the packs of a manifest that cannot be read are not known
    }
    for (const std::string& file : former) {
      work_.tick();
      const std::string pack = pack_of_former(file);
      if (!pack.empty() && !needed.contains(pack)) remove_file(work_.store, pack);
      remove_file(work_.store, file);
    }
  }
  /// The pack that the file of a former shard names. Empty if the file is damaged: then the end of a build removes the
  /// pack.
  [[nodiscard]] std::string pack_of_former(const std::string& file) const {
    try {
      const auto shard = built_shard(work_, std::filesystem::path(file).stem().string());
      return shard ? pack_file(shard->pack) : "";
    } catch (const Error&) {
      return "";
    }
  }
  [[nodiscard]] bool is_there(const ShardInfo& shard) const {
    return !damaged_.contains(shard.pack) && size_of(work_.store, pack_file(shard.pack)) == shard.bytes;
  }

  [[nodiscard]] bool unchanged() const {
    if (!in_force_ || in_force_->lossless != plan_.lossless || in_force_->options != plan_.options ||
        in_force_->format != format_version || !reader_.unknown().empty() ||
        in_force_->parts.size() != plan_.parts.size()) {
      return false;
    }
    for (std::size_t i = 0; i < plan_.parts.size(); ++i) {
      const PartInfo &now = plan_.parts[i].info, &then = in_force_->parts[i];
      if (now.name != then.name || now.fingerprint != then.fingerprint || now.file != then.file) return false;
    }
    return std::all_of(in_force_->shards.begin(), in_force_->shards.end(),
                       [&](const ShardInfo& shard) { return is_there(shard); });
  }

  /// Decides the shards as far as the parts' runs allow. `missing_` gets the parts that must be read first.
  void lay_out() {
    PartCells cells(work_, plan_.parts);
    std::vector<Stretch> stretches =
        divide(static_cast<std::uint32_t>(plan_.parts.size()), std::ref(cells), most_cells_of_plan());
    missing_ = cells.unread();
    if (stretches.empty()) {
      remove_results();
      throw Error("the scene holds no triangle; check its files, and --ignore");
    }
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

  /// Half of the memory.
  [[nodiscard]] std::size_t most_cells_of_plan() const {
    return static_cast<std::size_t>(work_.options.memory / (2 * sizeof(PartCell)));
  }

  /// If a scene cannot become a store, its results are removed.
  void remove_results() const {
    if (in_force_) return;
    remove_scratch(work_.store);
    for (const PartRecord& part : plan_.parts) remove_file(work_.store, part_file(part.info.file));
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
  Plan plan_;
  SceneReader reader_;
  std::optional<Manifest> in_force_;
  std::set<std::size_t> missing_;
};

}  // namespace

std::optional<Plan> make_plan(Work& work, const std::set<std::string>& damaged, StoreBuildReport& report) {
  return Planner(work, damaged, report).run();
}

}  // namespace roam::store
