#pragma once
/// \file
/// The plan of a build: the parts of the scene and the shards of the store.

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "store/build/divide.h"
#include "store/build/intake.h"
#include "store/build/work.h"
#include "store/manifest.h"

namespace roam::store {

struct PlannedShard {
  Stretch stretch;
  std::string key;         ///< see key_of
  bool in_force = false;   ///< in the store in force
  std::uint64_t task = 0;  ///< that builds it, if it is not in force: see assign_tasks
};

struct Plan {
  std::string options;  ///< text_of(ImportOptions)
  bool lossless = false;
  std::vector<PartRecord> parts;
  std::vector<PlannedShard> shards;
  std::uint64_t tasks = 0;

  /// The shards that are not in force, or those of one task.
  [[nodiscard]] std::vector<std::size_t> to_build() const;
  [[nodiscard]] std::vector<std::size_t> to_build(std::uint64_t task) const;
};

/// The key of a shard: a hash of everything that decides its content. That is the format, the version of the builder,
/// the import options, the stretch, and its parts.
[[nodiscard]] std::string key_of(const Stretch& stretch, const Plan& plan);

/// The plan in the scratch folder. Throws NothingPlanned if there is none, and roam::Error if it is unusable, if it was
/// made with another key, or if it takes more than half of the memory.
[[nodiscard]] Plan read_plan(const Work& work);
void write_plan(const Work& work, const Plan& plan);

/// The manifest in force, if there is a store. Throws TooLarge, and as read_manifest, within the memory of the build.
[[nodiscard]] std::optional<Manifest> manifest_in_force(const Work& work);

/// The notes of each part of a store, as in PartRecord.
[[nodiscard]] std::vector<std::vector<std::string>> notes_by_part(const Manifest& manifest);

/// Reads the changed parts and decides the shards. None if the store is up to date. Files whose SHA-256 is in `damaged`
/// count as missing. The store must be locked.
[[nodiscard]] std::optional<Plan> make_plan(Work& work, const std::set<std::string>& damaged, StoreBuildReport& report);

/// The shard, if it was built with the same key and waits to be merged.
[[nodiscard]] std::optional<ShardInfo> built_shard(const Work& work, const std::string& key);

}  // namespace roam::store
