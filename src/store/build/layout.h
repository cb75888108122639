#pragma once
/// \file
/// Where a build keeps what is not yet, or not at all, part of the store.

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "store/files.h"

namespace roam::store {

/// What is in the scratch folder is of no use to another version of this.
inline constexpr int scratch_version = 1;

// All in the folder of the store.
/// Digits of the id of a part that was read.
inline constexpr std::size_t record_digits = 24;
inline constexpr const char* scratch_folder = "scratch";
inline constexpr const char* plan_file = "scratch/plan.json";
/// Of a shard that was built: a ShardInfo.
inline std::string shard_file(const std::string& key) { return "scratch/shards/" + key + ".json"; }
/// Of a part that was read. `id`: see PartRecord.
inline std::string record_file(const std::string& id) { return "scratch/parts/" + id + ".json"; }
inline std::string run_file(const std::string& id, std::size_t run) {
  return fmt::format("scratch/runs/{}.{}.run", id, run);
}
/// What the files of the scene were when they were last looked at: see fingerprint.h. May be removed at any time.
inline constexpr const char* sources_file = "sources.json";

/// Whether a build that was ended may have left a file of this name in the folder of the store itself.
inline bool is_temporary_of_root(std::string_view name) {
  return is_temporary(name, [](std::string_view of) { return of == current_file || of == sources_file; });
}

}  // namespace roam::store
