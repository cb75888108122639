#pragma once
/// \file
/// Where a build keeps what is not yet, or not at all, part of the store.

#include <fmt/format.h>

#include <filesystem>
#include <string>

namespace roam::store {

/// What is in the scratch folder is of no use to another version of this.
inline constexpr int scratch_version = 1;

inline std::filesystem::path scratch_folder(const std::filesystem::path& store) { return store / "scratch"; }
inline std::filesystem::path plan_file(const std::filesystem::path& store) {
  return scratch_folder(store) / "plan.json";
}
/// Of a shard that was built: a ShardInfo.
inline std::filesystem::path shard_file(const std::filesystem::path& store, const std::string& key) {
  return scratch_folder(store) / "shards" / (key + ".json");
}
/// Of a part that was read. `id`: see PartRecord.
inline std::filesystem::path record_file(const std::filesystem::path& store, const std::string& id) {
  return scratch_folder(store) / "parts" / (id + ".json");
}
inline std::filesystem::path run_file(const std::filesystem::path& store, const std::string& id, std::size_t run) {
  return scratch_folder(store) / "runs" / fmt::format("{}.{}.run", id, run);
}
/// What the files of the scene were when they were last looked at: see fingerprint.h. May be removed at any time.
inline std::filesystem::path sources_file(const std::filesystem::path& store) { return store / "sources.json"; }

}  // namespace roam::store
