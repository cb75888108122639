#pragma once
/// \file
/// Names of the files of a build that are not, or not yet, part of the store.

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "store/files.h"

namespace roam::store {

/// Another version of the scratch folder is ignored.
inline constexpr int scratch_version = 4;

// All in the folder of the store.
/// Digits of the id of a record.
inline constexpr std::size_t record_digits = 24;
inline constexpr const char* scratch_folder = "scratch";
inline constexpr const char* plan_file = "scratch/plan.json";
/// The ShardInfo of a finished shard.
inline std::string shard_file(const std::string& key) { return "scratch/shards/" + key + ".json"; }
/// The record of a part that has been read. `id`: see PartRecord.
inline std::string record_file(const std::string& id) { return "scratch/parts/" + id + ".json"; }
inline std::string run_file(const std::string& id, std::size_t run) {
  return fmt::format("scratch/runs/{}.{}.run", id, run);
}
/// The id in the name of a run; empty for any other file.
inline std::string_view id_of_run(std::string_view file) {
  constexpr std::string_view start = "scratch/runs/", end = ".run";
  if (!file.starts_with(start) || !file.ends_with(end)) return {};
  file = file.substr(start.size(), file.size() - start.size() - end.size());
  const std::string_view id = file.substr(0, file.find('.')),
                         number = file.substr(std::min(file.size(), id.size() + 1));
  const bool is_run = !number.empty() && number.find_first_not_of("0123456789") == std::string_view::npos;
  return is_run && is_digits(id, record_digits) ? id : std::string_view();
}
/// State of the scene's files at the last examination: see fingerprint.h. May be removed at any time.
inline constexpr const char* sources_file = "sources.json";

/// Whether an interrupted build may have left a file of this name in the store's root folder.
inline bool is_temporary_of_root(std::string_view name) {
  return is_temporary(name, [](std::string_view of) { return of == current_file || of == sources_file; });
}

}  // namespace roam::store
