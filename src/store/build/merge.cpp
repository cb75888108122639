#include "store/build/merge.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <map>
#include <mutex>

#include "roam/error.h"
#include "store/authentic.h"
#include "store/build/layout.h"
#include "store/build/root.h"
#include "store/build/tasks.h"
#include "store/files.h"

namespace roam::store {
namespace {

namespace fs = std::filesystem;

/// Ranges of incomplete tasks that an error names, at most.
constexpr std::size_t named = 20;

/// An error that names the tasks to repeat. `missing` and `damaged`: shards, not empty together.
Incomplete incomplete(const Work& work, const Plan& plan, const std::vector<std::size_t>& missing,
                      const std::vector<std::size_t>& damaged) {
  std::set<std::uint64_t> tasks;
  for (const std::size_t i : missing) tasks.insert(plan.shards[i].task);
  for (const std::size_t i : damaged) tasks.insert(plan.shards[i].task);
  const std::vector<std::uint64_t> numbers(tasks.begin(), tasks.end());
  return Incomplete(Error::at(
      work.store.string(),
      fmt::format(
          "cannot merge {}: missing shards: {}, damaged shards: {}, in tasks {} of {}; build these tasks again, "
          "each with --shard and its number, and merge again; if one says that its run is gone, plan first",
          work.store.string(), missing.size(), damaged.size(), ranges_text(numbers, named), plan.tasks)));
}

/// The shards of the plan, each checked. Newly built ones are checked to the last byte.
std::vector<ShardInfo> collect(Work& work, const Plan& plan) {
  std::map<std::string, ShardInfo> before;
  if (const auto manifest = manifest_in_force(work)) {
    for (const ShardInfo& shard : manifest->shards) before[shard.key] = shard;
  }
  std::vector<ShardInfo> shards(plan.shards.size());
  const std::vector<std::size_t> built = plan.to_build();
  enum class State : std::uint8_t { whole, missing, damaged };
  std::vector<State> states(built.size(), State::whole);
  for (std::size_t i = 0; i < plan.shards.size(); ++i) {
    if (!plan.shards[i].in_force) continue;
    const auto old = before.find(plan.shards[i].key);
    if (old == before.end() || size_of(work.store, pack_file(old->second.pack)) != old->second.bytes) {
      throw Error::at(work.store.string(),
                      fmt::format("{} has been changed since the plan was made; plan again", work.store.string()));
    }
    shards[i] = old->second;
  }
  FileHashes hashes(work.store);
  work.arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, built.size(), [&](std::size_t b) {
      const PlannedShard& planned = plan.shards[built[b]];
      const auto shard = built_shard(work, planned.key);
      if (!shard) {
        states[b] = State::missing;
      } else if (hashes.sha256(pack_file(shard->pack), [&](std::uint64_t) { work.tick(); }) != shard->pack) {
        remove_file(work.store, shard_file(planned.key));
        states[b] = State::damaged;
      } else {
        shards[built[b]] = *shard;
        work.add_triangles(shard->triangles);
      }
    });
  });
  std::vector<std::size_t> missing, damaged;
  for (std::size_t b = 0; b < built.size(); ++b) {
    if (states[b] == State::missing) missing.push_back(built[b]);
    if (states[b] == State::damaged) damaged.push_back(built[b]);
  }
  if (!missing.empty() || !damaged.empty()) throw incomplete(work, plan, missing, damaged);
  return shards;
}

/// Removes a manifest, unless a process reads the store by it and therefore holds a shared lock on it. The manifest is
/// removed while locked here: a process that waits for the lock then finds it gone and reads CURRENT again.
void remove_unless_read(const Folder& store, const std::string& manifest) {
  // On network file systems, an exclusive lock needs a descriptor open for writing.
  const Descriptor opened = open_file(store, manifest, O_RDWR);
  if (!opened.is_open()) return;
  const bool read = ::flock(opened.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (!read) remove_file(store, manifest);
}

/// Whether a build writes a file of this name into the scratch folder.
bool is_scratch(std::string_view file) {
  if (file == plan_file) return true;
  const auto is = [&](std::string_view start, std::string_view extension, std::size_t digits) {
    if (!file.starts_with(start) || !file.ends_with(extension)) return false;
    return is_digits(file.substr(start.size(), file.size() - start.size() - extension.size()), digits);
  };
  return is("scratch/parts/", ".json", record_digits) || is("scratch/shards/", ".json", 64) || !id_of_run(file).empty();
}

/// Throws TooLarge for a manifest that a build of this memory could not read again. Returns a sentence for the user if
/// many verbs cannot read it, else an empty text.
std::string demand_fits(const Manifest& manifest, const Work& work, std::uint64_t usual) {
  const std::string text = to_text(manifest);
  std::uint64_t kept = 0;
  static_cast<void>(parse_manifest(text, "the new manifest of " + work.store.string(), work.options.memory, &kept));
  const std::uint64_t needed = text.size() + kept;
  if (needed <= usual) return "";
  return fmt::format(
      "the manifest of {} takes {} MiB: verbs that have --memory open it with more than that; other verbs do "
      "not",
      work.store.string(), (needed >> 20) + 1);
}

void keep(const Manifest& manifest, std::set<std::string>& files) {
  for (const PartInfo& part : manifest.parts) files.insert(part_file(part.file));
  for (const ShardInfo& shard : manifest.shards) files.insert(pack_file(shard.pack));
}

}  // namespace

std::set<std::string> files_of_manifests(const Folder& store, std::uint64_t memory) {
  std::set<std::string> files;
  for (const std::string& file : files_in(store, "manifests")) {
    if (!is_named_by_hash(file, ".json")) continue;
    files.insert(codes_file(fs::path(file).stem().string()));
    const std::vector<std::byte> bytes = read_file(store, file, memory);
    keep(parse_manifest({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file, memory), files);
  }
  return files;
}

std::string tidy(const Folder& store, std::uint64_t memory, bool keeps_versions) {
  std::string hash;
  const Manifest manifest = read_manifest(*files_of(store), store.string(), &hash, nullptr, memory);
  for (const std::string& file : files_in(store, "manifests")) {
    if (is_temporary(file, [](auto name) { return name == manifest_file("new"); })) remove_file(store, file);
    if (!is_named_by_hash(file, ".json") || file == manifest_file(hash) || keeps_versions) continue;
    remove_unless_read(store, file);
  }
  std::set<std::string> needed = files_of_manifests(store, memory);
  needed.insert(spare_file(keep_spare(store, manifest)));
  constexpr std::array<std::pair<const char*, const char*>, 4> kinds{
      {{"packs", ".pack"}, {"parts", ".part"}, {"spare", ".json"}, {"codes", ".hmac"}}};
  for (const auto& [folder, extension] : kinds) {
    const std::string unnamed = std::string(folder) + "/new" + extension;
    const auto is_final = [&, end = extension](std::string_view name) {
      return is_named_by_hash(name, end) || name == unnamed;
    };
    for (const std::string& file : files_in(store, folder)) {
      const bool ours = is_named_by_hash(file, extension) || is_temporary(file, is_final);
      if (ours && !needed.contains(file)) remove_file(store, file);
    }
  }
  for (const std::string& file : files_in(store, "")) {
    if (is_temporary_of_root(file)) remove_file(store, file);
  }
  return remove_scratch(store);
}

std::string remove_scratch(const Folder& store) {
  // The plan first: without it the rest does not count as a build in progress.
  remove_file(store, plan_file);
  for (const char* folder : {"scratch", "scratch/parts", "scratch/runs", "scratch/shards"}) {
    for (const std::string& file : files_in(store, folder)) {
      if (is_scratch(file) || is_temporary(file, is_scratch)) remove_file(store, file);
    }
    if (std::string(folder) != scratch_folder) remove_folder(store, folder);
  }
  if (remove_folder(store, scratch_folder) || errno == ENOENT) return "";
  return fmt::format("{} could not be removed ({}): nothing needs it; remove it, or the next build tries again",
                     (store / scratch_folder).string(), std::strerror(errno));
}

std::vector<std::string> merge(Work& work, const Plan& plan, std::uint64_t usual) {
  std::uint64_t triangles = 0;
  for (const PlannedShard& shard : plan.shards) triangles += shard.in_force ? 0 : shard.stretch.triangles;
  work.begin(Work::Step::merge, 0, triangles);
  Manifest manifest;
  manifest.lossless = plan.lossless;
  manifest.options = plan.options;
  manifest.shards = collect(work, plan);
  for (const PartRecord& part : plan.parts) {
    manifest.parts.push_back(part.info);
    manifest.notes.insert(manifest.notes.end(), part.notes.begin(), part.notes.end());
  }
  for (const ShardInfo& shard : manifest.shards) {
    manifest.bounds.include(shard.bounds);
    manifest.geometry_hash += shard.geometry_hash;
  }
  std::string large = demand_fits(manifest, work, usual);
  const std::string hash = keep_spare(work.store, manifest);
  if (work.options.key) add_code(work.store, hash, *work.options.key);
  publish(work.store, manifest);
  return {std::move(large), tidy(work.store, work.options.memory)};
}

}  // namespace roam::store
