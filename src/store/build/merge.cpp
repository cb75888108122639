#include "store/build/merge.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <cerrno>
#include <map>
#include <mutex>

#include "roam/error.h"
#include "store/build/layout.h"
#include "store/build/root.h"
#include "store/files.h"

namespace roam::store {
namespace {

namespace fs = std::filesystem;

/// How many missing shards an error names.
constexpr std::size_t kNamed = 5;

/// The shards of the plan, each checked: those that were built for it to the last byte.
std::vector<ShardInfo> collect(Work& work, const Plan& plan) {
  std::map<std::string, ShardInfo> before;
  if (const auto manifest = manifest_in_force(work.store)) {
    for (const ShardInfo& shard : manifest->shards) before[shard.key] = shard;
  }
  std::vector<ShardInfo> shards(plan.shards.size());
  std::vector<std::string> wrong(plan.shards.size());
  const std::vector<std::size_t> built = plan.to_build();
  for (std::size_t i = 0; i < plan.shards.size(); ++i) {
    if (!plan.shards[i].there) continue;
    const auto old = before.find(plan.shards[i].key);
    std::error_code error;
    if (old == before.end() || fs::file_size(work.store / pack_file(old->second.pack), error) != old->second.bytes ||
        error) {
      throw Error(fmt::format("{} has been changed since the plan was made; plan again", work.store.string()));
    }
    shards[i] = old->second;
  }
  work.arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, built.size(), [&](std::size_t b) {
      const PlannedShard& planned = plan.shards[built[b]];
      const auto shard = built_shard(work.store, planned.key);
      if (!shard) {
        wrong[b] = "missing";
      } else if (sha256_of_file(work.store / pack_file(shard->pack), [&](std::uint64_t) { work.tick(); }) !=
                 shard->pack) {
        std::error_code error;
        fs::remove(shard_file(work.store, planned.key), error);
        wrong[b] = "damaged";
      } else {
        shards[built[b]] = *shard;
        work.add_triangles(shard->triangles);
      }
    });
  });
  std::string list;
  std::size_t count = 0;
  for (std::size_t b = 0; b < built.size(); ++b) {
    if (wrong[b].empty()) continue;
    if (++count <= kNamed) list += fmt::format("{}shard {} is {}", list.empty() ? "" : ", ", b, wrong[b]);
  }
  if (count > kNamed) list += fmt::format(", and {} more", count - kNamed);
  if (count > 0) {
    throw Error(fmt::format("cannot merge {}: {} (of {} to be built); build them, and merge again", work.store.string(),
                            list, built.size()));
  }
  return shards;
}

/// Removes a manifest unless a process reads the store by it, which then holds a shared lock on it. It is removed while
/// it is locked here: who waits for the lock finds it gone, and looks at CURRENT again. Returns whether it was removed.
bool remove_unless_read(const fs::path& manifest) {
  // Network file systems lock against readers only what may be written.
  const int descriptor = ::open(manifest.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool read = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  std::error_code error;
  const bool removed = !read && fs::remove(manifest, error);
  ::close(descriptor);
  return removed;
}

void keep(const Manifest& manifest, std::set<std::string>& files) {
  for (const PartInfo& part : manifest.parts) files.insert(part_file(part.file));
  for (const ShardInfo& shard : manifest.shards) files.insert(pack_file(shard.pack));
}

}  // namespace

std::string tidy(const fs::path& store) {
  std::string hash;
  const Manifest manifest = read_manifest(*files_of(store), store.string(), &hash);
  std::set<std::string> needed;
  keep(manifest, needed);
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(store / "manifests", error)) {
    if (entry.path() == store / manifest_file(hash) || remove_unless_read(entry.path())) continue;
    const std::string name = "manifests/" + entry.path().filename().string();
    const std::vector<std::byte> bytes = read_file(entry.path(), 1ull << 30);
    keep(parse_manifest(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), name), needed);
  }
  needed.insert(spare_file(keep_spare(store, manifest)));
  for (const char* folder : {"packs", "parts", "spare"}) {
    for (const auto& entry : fs::directory_iterator(store / folder, error)) {
      const std::string name = std::string(folder) + "/" + entry.path().filename().string();
      if (!needed.contains(name)) fs::remove(entry.path(), error);
    }
  }
  for (const auto& entry : fs::directory_iterator(store, error)) {
    if (entry.path().filename().string().ends_with(temporary_suffix)) fs::remove(entry.path(), error);
  }
  return remove_scratch(store);
}

std::string remove_scratch(const fs::path& store) {
  std::error_code error;
  // The plan first: without it nothing of the rest is taken for a build in progress.
  fs::remove(plan_file(store), error);
  fs::remove_all(scratch_folder(store), error);
  if (!error) return "";
  return fmt::format("{} could not be removed ({}): nothing needs it; remove it, or the next build tries again",
                     scratch_folder(store).string(), error.message());
}

std::string merge(Work& work, const Plan& plan) {
  std::uint64_t triangles = 0;
  for (const PlannedShard& shard : plan.shards) triangles += shard.there ? 0 : shard.stretch.triangles;
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
  keep_spare(work.store, manifest);
  publish(work.store, manifest);
  return tidy(work.store);
}

}  // namespace roam::store
