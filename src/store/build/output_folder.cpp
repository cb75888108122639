#include "store/build/output_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>
#include <vector>

#include "roam/error.h"
#include "store/build/layout.h"

namespace roam::store {
namespace {

namespace fs = std::filesystem;

/// Whether a build puts something of this name into the folder of a store.
bool is_ours(const std::string& name) {
  static const std::set<std::string> ours{current_file, lock_file,    "manifests", "packs", "parts",
                                          "scratch",    sources_file, "spare",     "codes"};
  return ours.contains(name) || is_temporary_of_root(name);
}

/// Whether there is anything that read_part, build_shard or merge has finished.
bool holds_results(const fs::path& store) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(store / current_file, error)) || fs::exists(store / plan_file, error)) return true;
  for (const char* folder : {"packs", "parts", "manifests", "spare", "scratch/parts", "scratch/shards"}) {
    for (const auto& entry : fs::directory_iterator(store / folder, error)) {
      if (!entry.path().filename().string().ends_with(files::temporary_suffix)) return true;
    }
  }
  return false;
}

}  // namespace

std::unique_ptr<BuildLock> locked(const fs::path& store, const BuildProgress& progress) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds longest{1}, longest_remainder{5};
  constexpr std::chrono::milliseconds period{50};
  for (const Clock::time_point start = Clock::now();;) {
    try {
      return std::make_unique<BuildLock>(store);
    } catch (const LockedError& error) {
      if (Clock::now() - start > (error.holder_ended ? longest_remainder : longest)) throw;
    }
    if (progress && !progress({})) throw Cancelled();
    std::this_thread::sleep_for(period);
  }
}

std::string other_thing_in(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    std::string name = entry.path().filename().string();
    if (!is_ours(name)) return name;
  }
  if (error) throw Error(fmt::format("cannot read the folder {}: {}", folder.string(), error.message()));
  return "";
}

OutputFolder::OutputFolder(fs::path store, const BuildProgress& progress) : store_(std::move(store)) {
  std::error_code error;
  fs::path path = fs::absolute(store_, error).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  // A link that leads nowhere is there, too.
  while (!fs::exists(fs::symlink_status(path, error)) && path != path.parent_path()) {
    made_.insert(path);
    path = path.parent_path();
  }
  const bool had_lock = fs::exists(store_ / lock_file, error);
  try {
    make_folder(store_);
    lock_ = locked(store_, progress);
  } catch (...) {
    remove_made_folders();
    throw;
  }
  for (const auto& entry : fs::directory_iterator(store_, error)) there_.insert(entry.path().filename().string());
  if (!had_lock) there_.erase(lock_file);
}

OutputFolder::~OutputFolder() {
  if (keeps_ || holds_results(store_)) return;
  // What cannot be removed stays: what went wrong before is what is told.
  std::error_code error;
  std::vector<fs::path> ours;
  for (const auto& entry : fs::directory_iterator(store_, error)) {
    const std::string name = entry.path().filename().string();
    if (is_ours(name) && !there_.contains(name)) ours.push_back(entry.path());
  }
  for (const fs::path& path : ours) fs::remove_all(path, error);
  remove_made_folders();
}

/// As far as they are empty: others may have put things there.
void OutputFolder::remove_made_folders() const {
  std::error_code error;
  std::for_each(made_.rbegin(), made_.rend(), [&](const fs::path& folder) { fs::remove(folder, error); });
}

}  // namespace roam::store
