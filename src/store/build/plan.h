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
  std::string key;     ///< see key_of
  bool there = false;  ///< in the store that is in force
};

struct Plan {
  std::string options;  ///< text_of(ImportOptions)
  bool lossless = false;
  std::vector<PartRecord> parts;
  std::vector<PlannedShard> shards;

  [[nodiscard]] std::vector<std::size_t> to_build() const;
};

/// Says of what a shard is made: of the format, of what this version of the builder makes of triangles, of how the
/// scene is read, and of which stretch of which parts.
[[nodiscard]] std::string key_of(const Stretch& stretch, const Plan& plan);

/// The plan in the scratch folder. Throws roam::Error when there is none that can be used, it was made with another
/// key, or it takes more than half of the memory.
[[nodiscard]] Plan read_plan(const Work& work);
void write_plan(const Work& work, const Plan& plan);

/// The manifest in force, if there is a store.
[[nodiscard]] std::optional<Manifest> manifest_in_force(const std::filesystem::path& store);

/// The notes of each part of a store, as PartRecord has them.
[[nodiscard]] std::vector<std::vector<std::string>> notes_by_part(const Manifest& manifest);

/// Throws roam::Error when the output cannot be one for this scene.
void check_output(const StoreBuildOptions& options);

/// Reads what has changed and decides the shards. Nothing when the store is up to date. Files (SHA-256) that are
/// `damaged` count as missing. The store must be locked.
[[nodiscard]] std::optional<Plan> make_plan(Work& work, const std::set<std::string>& damaged, StoreBuildReport& report);

/// Whether a shard of the plan was built, with the same key, and waits to be merged.
[[nodiscard]] std::optional<ShardInfo> built_shard(const Work& work, const std::string& key);

}  // namespace roam::store
