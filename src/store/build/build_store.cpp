// The three steps of a build, for programs: see roam/store_build.h.
#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <memory>
#include <set>

#include "math/floating_point.h"
#include "roam/store_build.h"
#include "store/authentic.h"
#include "store/build/fingerprint.h"
#include "store/build/layout.h"
#include "store/build/merge.h"
#include "store/build/notes.h"
#include "store/build/output_folder.h"
#include "store/build/plan.h"
#include "store/build/root.h"
#include "store/build/scene_reader.h"
#include "store/build/shard.h"
#include "store/build/tasks.h"
#include "store/files.h"

namespace roam {
namespace {

using namespace store;
namespace fs = std::filesystem;

void make_folders(const Folder& store) {
  for (const char* name : {"packs", "parts", "manifests", "scratch/runs", "scratch/parts", "scratch/shards"}) {
    make_folder_in(store, name);
  }
}

/// Forgets what an earlier step reported, except its time.
void begin_step(StoreBuildReport& report) {
  StoreBuildReport now;
  now.read_seconds = report.read_seconds;
  now.plan_seconds = report.plan_seconds;
  now.shard_seconds = report.shard_seconds;
  now.merge_seconds = report.merge_seconds;
  report = std::move(now);
}

void count(const Plan& plan, StoreBuildReport& report) {
  report.triangles = report.triangles_to_build = 0;
  for (const PlannedShard& shard : plan.shards) report.triangles += shard.stretch.triangles;
  report.shards = plan.shards.size();
  report.shards_to_build = plan.to_build().size();
  report.tasks = plan.tasks;
  report.longest_task = longest_task(plan);
  for (const std::size_t i : plan.to_build()) report.triangles_to_build += plan.shards[i].stretch.triangles;
  report.parts = plan.parts.size();
}

void describe(const Plan& plan, StoreBuildReport& report) {
  count(plan, report);
  Notes notes;
  for (const PartRecord& part : plan.parts) notes.add(part.info.name, part.notes);
  notes.prepend_to(report.notes);
}

/// Adds a note. Notes are whole sentences.
void note(StoreBuildReport& report, std::string sentence) {
  if (!sentence.empty()) report.notes.push_back(std::move(sentence));
}

/// The store in the folder that is held, even if its path leads elsewhere by now.
std::shared_ptr<const Store> opened(const Work& work) {
  return open_store(files_of(work.store), work.store.string(), work.options.memory);
}

/// Repairs the root of the store before planning, or removes it. Returns the damage as a sentence for the user.
/// Throws Error, without any change, if nothing shows that the store was built with the key.
std::string mend_or_remove_root(Work& work) {
  const std::string store = work.store.string();
  const std::optional<StoreKey> key = work.options.adopt ? std::nullopt : work.options.key;
  const RootMending mending = mend_root(work, key);
  if (mending.wrong.empty()) return "";
  if (!mending.mended && key && holds_results(work.store)) {
    throw Error(store, fmt::format("its {}, and no copy of its manifest has the code of your key, so nothing shows "
                                   "that you built it; --adopt builds all of it again; else remove it, or choose "
                                   "another output",
                                   mending.wrong));
  }
  std::string sentence = fmt::format("{} was damaged: {}; ", store, mending.wrong);
  if (mending.mended) return sentence + "a copy of its manifest was whole, and what that names is kept";
  remove_file(work.store, current_file);
  return sentence + "no copy of its manifest was whole, so all of it is built again";
}

/// An existing store may have come with the scene. With a key, a build continues only a store that has a code of that
/// key. Returns the hash of a store that has none, and is to be adopted.
std::optional<std::string> demand_authentic(const Work& work) {
  if (!work.options.key || !is_file(work.store, current_file)) return {};
  const auto there = opened(work);
  if (there->is_authentic(*work.options.key)) return {};
  if (!work.options.adopt) {
    throw Error(
        work.store.string(),
        "it was not built with your key: it may have come with the scene, and lack a wall, or be a colleague's; if you "
        "trust whoever built it, --adopt makes it yours; else remove it, or choose another output");
  }
  return there->info().hash;
}

/// The manifest in force, as far as it can be read: the plan mends a damaged root, or builds all of it again.
std::optional<Manifest> readable_in_force(const Work& work) {
  try {
    demand_authentic(work);
    return manifest_in_force(work);
  } catch (const RootDamage&) {
    return {};
  }
}

void adopt_or_demand_authentic(const Work& work) {
  if (const auto hash = demand_authentic(work)) add_code(work.store, *hash, *work.options.key);
}

/// Returns no plan if the store is up to date.
std::optional<Plan> plan_locked(Work& work, const std::set<std::string>& damaged, StoreBuildReport& report) {
  std::string mended = mend_or_remove_root(work);
  const double read_before = report.read_seconds;
  std::optional<Plan> plan;
  {
    const Timer timer(report.plan_seconds);
    adopt_or_demand_authentic(work);
    make_folders(work.store);
    plan = make_plan(work, damaged, report);
    if (plan) assign_tasks(*plan, work.options.tasks);
    if (plan) write_plan(work, *plan);
  }
  report.plan_seconds -= report.read_seconds - read_before;
  if (plan) {
    describe(*plan, report);
    note(report, std::move(mended));
    return plan;
  }
  std::string left = tidy(work.store, work.options.memory);  // a build may have been killed after it had published
  report.unchanged = true;
  report.store = opened(work)->info();
  const Manifest manifest = *manifest_in_force(work);
  report.shards = manifest.shards.size();
  Notes notes;
  const auto by_part = notes_by_part(manifest);
  for (std::size_t i = 0; i < manifest.parts.size(); ++i) {
    report.triangles += manifest.parts[i].triangles;
    notes.add(manifest.parts[i].name, by_part[i]);
  }
  notes.prepend_to(report.notes);
  note(report, std::move(mended));
  note(report, std::move(left));
  return plan;
}

/// As plan_locked, without damaged files. Keeps the output if cancelled.
std::optional<Plan> plan_output(Work& work, OutputFolder& output, StoreBuildReport& report) {
  try {
    return plan_locked(work, {}, report);
  } catch (const Cancelled&) {
    output.keep();  // the same command continues from there
    throw;
  }
}

/// A lower bound of the squared distance between a place and the triangles of a stretch, by the middles of their boxes.
double distance2(const Stretch& stretch, const Vec3& place) {
  double least = std::numeric_limits<double>::infinity();
  for (const CurveCell& cell : stretch.cells) {
    constexpr CurveKey places = (CurveKey{1} << AbsoluteCurve::class_shift) - 1;
    // A cell of several size classes covers all places.
    const bool all = cell.bits >= AbsoluteCurve::class_shift;
    const CurveKey lower = all ? 0 : cell.key & places, upper = all ? places : cell.last() & places;
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
      const auto metres = [&](CurveKey key) {
        return AbsoluteCurve::curve_origin +
               AbsoluteCurve::cell_size * double(AbsoluteCurve::gather(key >> k & AbsoluteCurve::axis_mask));
      };
      const double beside =
          std::max({0.0, metres(lower) - place[k], place[k] - metres(upper) - AbsoluteCurve::cell_size});
      sum += beside * beside;
    }
    least = std::min(least, sum);
  }
  return least;
}

/// Builds these shards. Syncs each one while the next one is built.
void build_shards(Work& work, const Plan& plan, std::vector<std::size_t> numbers, StoreBuildReport& report) {
  const Timer timer(report.shard_seconds);
  if (const auto& place = work.options.nearest_first) {
    std::vector<double> distance(plan.shards.size());
    for (const std::size_t i : numbers) distance[i] = distance2(plan.shards[i].stretch, *place);
    std::stable_sort(numbers.begin(), numbers.end(), [&](auto a, auto b) { return distance[a] < distance[b]; });
  }
  std::uint64_t triangles = 0;
  for (const std::size_t i : numbers) triangles += plan.shards[i].stretch.triangles;
  work.begin(Work::Step::shards, 0, triangles);
  std::future<void> publishing;
  try {
    for (const std::size_t i : numbers) {
      const PlannedShard& shard = plan.shards[i];
      if (built_shard(work, shard.key)) {
        work.add_triangles(shard.stretch.triangles);
        work.tick();
        continue;
      }
      const std::function<void()> publish = make_shard(work, plan, shard);
      if (publishing.valid()) publishing.get();
      publishing = std::async(std::launch::async, publish);
      ++report.shards_built;
    }
    if (publishing.valid()) publishing.get();
  } catch (...) {
    // The shard being published is complete, and stays.
    if (publishing.valid()) publishing.wait();
    throw;
  }
}

void merge_locked(Work& work, const Plan& plan, StoreBuildReport& report) {
  const Timer timer(report.merge_seconds);
  for (std::string& sentence : merge(work, plan)) note(report, std::move(sentence));
  report.store = opened(work)->info();
}

/// Builds what is missing, and merges. A shard that has been damaged since it was built is built once more.
void build_and_merge(Work& work, const Plan& plan, StoreBuildReport& report) {
  build_shards(work, plan, plan.to_build(), report);
  try {
    merge_locked(work, plan, report);
    return;
  } catch (const Incomplete&) {
  }
  StoreBuildReport replanned;
  const std::optional<Plan> again = plan_locked(work, {}, replanned);
  if (!again) throw Error(work.store.string(), "another program has changed it meanwhile; build it again");
  count(*again, report);
  report.parts_read = std::min(report.parts_read + replanned.parts_read, report.parts);
  report.read_seconds += replanned.read_seconds;
  report.plan_seconds += replanned.plan_seconds;
  build_shards(work, *again, again->to_build(), report);
  report.shards_built = std::min(report.shards_built, report.shards);
  merge_locked(work, *again, report);
}

}  // namespace

std::uint64_t plan_store(const StoreBuildOptions& options, StoreBuildReport& report) {
  const DefaultFloatingPoint guard;
  begin_step(report);
  Work work(options);
  check_output(options);
  OutputFolder output(work.store, options.through_link, options.progress);
  const auto plan = plan_output(work, output, report);
  return plan ? plan->tasks : 0;
}

void read_share(const StoreBuildOptions& options, std::uint64_t i, StoreBuildReport& report) {
  const DefaultFloatingPoint guard;
  begin_step(report);
  Work work(options);
  check_output(options);
  if (i >= options.tasks) {
    throw NoSuchTask(options.output.string(),
                     fmt::format("there is no share {} of {}: they are counted from 0", i, options.tasks));
  }
  std::vector<ScenePart> parts = listed_parts(work);  // before anything is written
  work.store = shared_output(options.output, options.through_link);
  const std::optional<Manifest> in_force = readable_in_force(work);
  const bool all_anew = in_force && (in_force->lossless != options.lossless || in_force->format != format_version);
  const std::set<std::string> none_damaged;
  std::vector<PartRecord> records;
  SceneReader reader(work, std::move(parts), none_damaged, report, records);
  const std::vector<std::size_t> share = reader.share(i, options.tasks);
  report.share_parts = share.size();
  reader.take_records(in_force, share);
  const std::vector<std::size_t> numbers = all_anew ? reader.without_runs(share) : reader.unknown();
  if (numbers.empty()) return;
  // A plan that failed meanwhile may have removed it.
  if (!work.store.is_in_place()) work.store = shared_output(options.output, options.through_link);
  make_folders(work.store);
  const ReadingSign sign(work.store);
  reader.read(numbers);
}

void build_task(const StoreBuildOptions& options, std::uint64_t i, StoreBuildReport& report) {
  const DefaultFloatingPoint guard;
  begin_step(report);
  Work work(options);
  work.store = Folder::held(options.output, options.through_link);
  const Plan plan = read_plan(work);
  describe(plan, report);
  if (plan.tasks == 0) {
    throw NoSuchTask(work.store.string(), "the plan has no shards to build; merge");
  }
  if (i >= plan.tasks) {
    throw NoSuchTask(work.store.string(),
                     fmt::format("there is no task {} in the plan: they go from 0 to {}", i, plan.tasks - 1));
  }
  report.task_shards = plan.to_build(i).size();
  build_shards(work, plan, plan.to_build(i), report);
}

void merge_store(const StoreBuildOptions& options, StoreBuildReport& report) {
  const DefaultFloatingPoint guard;
  begin_step(report);
  Work work(options);
  work.store = Folder::held(options.output, options.through_link);
  const auto lock = locked(work.store, options.progress);
  adopt_or_demand_authentic(work);
  const Plan plan = read_plan(work);
  describe(plan, report);
  merge_locked(work, plan, report);
}

StoreBuildReport build_store(const StoreBuildOptions& options) {
  const DefaultFloatingPoint guard;
  StoreBuildReport report;
  Work work(options);
  check_output(options);
  OutputFolder output(work.store, options.through_link, options.progress);
  const auto plan = plan_output(work, output, report);
  if (!plan) return report;
  build_and_merge(work, *plan, report);
  return report;
}

StoreBuildReport repair_store(const StoreBuildOptions& options) {
  const DefaultFloatingPoint guard;
  if (!Store::is_store(options.output) && !holds_store(options.output)) refuse_to_open(options.output);
  const Folder store = Folder::held(options.output, options.through_link);
  const auto lock = locked(store, options.progress);
  StoreBuildOptions as_built = options;
  Work work(as_built);
  work.store = store;
  const RootMending root = mend_root(work, std::nullopt);
  if (!root.wrong.empty() && !root.mended) {
    // A repair must restore the same store, but nothing records how it was built.
    throw Error::at(
        options.output.string(),
        fmt::format("{0} cannot be repaired: {1}, and no copy of the manifest is whole, so nothing tells how "
                    "it was built; `roam build` with its scene, `-o {0}`, --adopt, and the --up, --unit, --ignore, "
                    "--allow and --lossless that it was built with, builds it again",
                    options.output.string(), root.wrong));
  }
  if (!is_file(store, current_file)) refuse_to_open(options.output);
  const Manifest manifest = *manifest_in_force(work);
  as_built.lossless = manifest.lossless;
  read_as(manifest.options, as_built.import);
  if (options.key && !opened(work)->is_authentic(*options.key)) {
    // A repair gives it no code, and does not continue from anything that its builder left.
    as_built.key.reset();
    remove_scratch(store);
  }
  FileHashes hashes(work.store);
  std::set<std::string> damaged;
  std::set<std::string> checked;
  const auto check = [&](const std::string& hash, const std::string& file) {
    if (!checked.insert(file).second) return;
    if (!size_of(work.store, file) || hashes.sha256(file, [&](std::uint64_t) { work.tick(); }) != hash) {
      damaged.insert(hash);
    }
  };
  for (const PartInfo& part : manifest.parts) check(part.file, part_file(part.file));
  for (const ShardInfo& shard : manifest.shards) check(shard.pack, pack_file(shard.pack));
  keep_spare(work.store, manifest);
  StoreBuildReport report;
  if (damaged.empty()) return report;
  const auto plan = plan_locked(work, damaged, report);
  bool same = plan && plan->parts.size() == manifest.parts.size();
  for (std::size_t i = 0; same && i < plan->parts.size(); ++i) {
    same = plan->parts[i].info.name == manifest.parts[i].name &&
           plan->parts[i].info.fingerprint == manifest.parts[i].fingerprint;
  }
  if (!same) {
    static_cast<void>(tidy(work.store, work.options.memory));  // the parts of the other scene, too
    throw Error::at(
        work.store.string(),
        fmt::format("{} was not made of this scene as it is now: build it again instead", work.store.string()));
  }
  build_shards(work, *plan, plan->to_build(), report);
  try {
    merge_locked(work, *plan, report);
  } catch (const Incomplete&) {
    throw Error::at(work.store.string(), fmt::format("a pack of {} has changed while it was repaired; repair it again",
                                                     work.store.string()));
  }
  return report;
}

}  // namespace roam
