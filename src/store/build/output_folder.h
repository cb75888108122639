#pragma once
/// \file
/// The folder that a build writes into.

#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "roam/store_build.h"
#include "store/files.h"

namespace roam::store {

/// As in StoreBuildOptions.
using BuildProgress = std::function<bool(const StoreBuildProgress&)>;

/// Whether a path leads into a folder, or to the folder itself. Neither needs to be there.
[[nodiscard]] bool is_inside(const std::filesystem::path& inner, const std::filesystem::path& outer);

/// Throws roam::Error if the output folder cannot be used for this scene.
void check_output(const StoreBuildOptions& options);

/// Locks the store. Waits for another holder up to 1 s. If the holder's builder was killed while it started a reader,
/// waits up to 5 s, until that process has become the reader. While waiting it calls `progress`; false ends it. Throws
/// roam::Error naming the holder, and roam::Cancelled.
[[nodiscard]] std::unique_ptr<BuildLock> locked(const Folder& store, const BuildProgress& progress);

/// Whether the folder holds finished results of read_part, build_task or merge.
[[nodiscard]] bool holds_results(const Folder& store);

/// The folder of a store, open from then on; made if it does not exist. Takes no lock, and stays. Throws as
/// OutputFolder, except for locks.
[[nodiscard]] Folder shared_output(const std::filesystem::path& path, bool through_link);

/// A file in the scratch folder that counts as a result for its life: a plan that fails meanwhile does not take the
/// folders for its own, and leaves them.
class ReadingSign {
 public:
  /// The scratch folder must be there. Throws FileError.
  explicit ReadingSign(const Folder& store);
  ~ReadingSign();
  ReadingSign(const ReadingSign&) = delete;
  ReadingSign& operator=(const ReadingSign&) = delete;

 private:
  Folder store_;
  std::string name_;
};

/// Whether a ReadingSign is there, perhaps of a process that was killed.
[[nodiscard]] bool is_being_read(const Folder& store);

/// The folder of a store, locked; made if it does not exist. The destructor removes what builds put there, except after
/// keep(), if it was there before, or if a later build can continue from it.
class OutputFolder {
 public:
  /// Keeps `store` open from then on. Throws as `locked` and Folder::held, and if the folder holds other things than a
  /// store. Nothing has been written then.
  OutputFolder(Folder& store, bool through_link, const BuildProgress& progress);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  void keep() { keeps_ = true; }

 private:
  void remove_made_folders() const;

  Folder store_;
  std::vector<MadeFolder> made_;  ///< created folders: those above the store, and the store's own
  std::set<std::string> there_;   ///< entries of the store folder at the start
  std::unique_ptr<BuildLock> lock_;
  bool keeps_ = false;
};

}  // namespace roam::store
