#include "store/build/output_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <random>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "roam/error.h"
#include "store/build/layout.h"
#include "store/manifest.h"

namespace roam::store {
namespace {

namespace fs = std::filesystem;

fs::path whole_path(const fs::path& path) {
  std::error_code error;
  fs::path whole = fs::weakly_canonical(path, error);
  if (error)
    throw Error::at(path.string(), fmt::format("cannot find out where {} lies: {}", path.string(), error.message()));
  return whole;
}

/// Whether a build creates something of this name in the folder of a store.
bool is_ours(const std::string& name) {
  static const std::set<std::string> ours{current_file, lock_file,    "manifests", "packs", "parts",
                                          "scratch",    sources_file, "spare",     "codes"};
  return ours.contains(name) || is_temporary_of_root(name);
}

/// Throws if a folder is no store and holds something that no build creates. Other programs also have files named
/// CURRENT.
void demand_no_other_things(const Folder& store) {
  if (is_file(store, current_file) && holds_store(store)) return;
  for (const std::string& name : names_in(store, "")) {
    if (is_ours(name)) continue;
    throw Error::at(store.string(),
                    fmt::format("{} is a folder that holds other things ({}); choose another output, or empty it",
                                store.string(), name));
  }
}

}  // namespace

bool is_inside(const fs::path& inner, const fs::path& outer) {
  const fs::path relative = whole_path(inner).lexically_relative(whole_path(outer));
  return !relative.empty() && *relative.begin() != "..";
}

void check_output(const StoreBuildOptions& options) {
  const fs::path& out = options.output;
  std::error_code error;
  const fs::file_status status = fs::status(out, error);
  if (!fs::exists(status) && fs::is_symlink(out, error)) {
    throw Error::at(out.string(),
                    fmt::format("{} is a link that leads nowhere; remove it, or choose another output", out.string()));
  }
  if (fs::exists(status) && !fs::is_directory(status)) {
    throw Error::at(out.string(),
                    fmt::format("{} is a file: a store is a folder; choose another output", out.string()));
  }
  for (const fs::path& path : options.scene) {
    if (fs::is_directory(path, error) && is_inside(out, path)) {
      throw Error::at(out.string(), fmt::format("{} lies in the folder of the scene, {}; choose an output outside",
                                                out.string(), path.string()));
    }
    if (fs::exists(path, error) && is_inside(path, out)) {
      throw Error::at(path.string(), fmt::format("the scene {} lies in the output {}; choose another output",
                                                 path.string(), out.string()));
    }
  }
}

bool holds_results(const Folder& store) {
  const std::vector<std::string> names = names_in(store, "");
  if (std::count(names.begin(), names.end(), current_file) > 0 || is_file(store, plan_file)) return true;
  for (const char* folder :
       {"packs", "parts", "manifests", "spare", "scratch/runs", "scratch/parts", "scratch/shards"}) {
    for (const std::string& name : names_in(store, folder)) {
      if (!name.ends_with(files::temporary_suffix)) return true;
    }
  }
  return false;
}

std::unique_ptr<BuildLock> locked(const Folder& store, const BuildProgress& progress) {
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

Folder shared_output(const fs::path& path, bool through_link) {
  std::vector<MadeFolder> made;
  Folder store = Folder::held_or_made(path, through_link, made);
  demand_no_other_things(store);
  return store;
}

ReadingSign::ReadingSign(const Folder& store) : store_(store) {
  std::random_device random;
  name_ = record_file(fmt::format("{:08x}{:08x}{:08x}", random(), random(), random()));  // that no part has
  write_file(store_, name_, "");
}

ReadingSign::~ReadingSign() {
  try {
    remove_file(store_, name_);
  } catch (const std::exception&) {  // it stays until the store is merged
  }
}

bool is_being_read(const Folder& store) {
  const std::vector<std::string> records = files_in(store, "scratch/parts");
  return std::any_of(records.begin(), records.end(),
                     [&](const std::string& file) { return file.ends_with(".json") && size_of(store, file) == 0U; });
}

OutputFolder::OutputFolder(Folder& store, bool through_link, const BuildProgress& progress) : store_(store) {
  try {
    store = store_ = Folder::held_or_made(store.path(), through_link, made_);
    demand_no_other_things(store_);
    const bool had_lock = is_file(store_, lock_file);
    lock_ = locked(store_, progress);
    for (const std::string& name : names_in(store_, "")) there_.insert(name);
    if (!had_lock) there_.erase(lock_file);
  } catch (...) {
    remove_made_folders();
    throw;
  }
}

OutputFolder::~OutputFolder() {
  try {
    if (keeps_ || holds_results(store_)) return;
    for (const std::string& name : names_in(store_, "")) {
      if (is_ours(name) && !there_.contains(name)) remove_all(store_, name);
    }
  } catch (const std::exception&) {  // such entries stay: the earlier error matters more
  }
  if (store_.is_in_place()) remove_made_folders();
}

/// Removes folders only if they are empty, because others may have put things there. It removes no file and no link.
void OutputFolder::remove_made_folders() const {
  std::for_each(made_.rbegin(), made_.rend(),
                [](const MadeFolder& folder) { ::unlinkat(folder.above.number(), folder.name.c_str(), AT_REMOVEDIR); });
}

}  // namespace roam::store
