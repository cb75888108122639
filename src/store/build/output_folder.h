#pragma once
/// \file
/// The folder that a build writes into.

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

/// Locks the store. A builder that was killed while it started a reader leaves a process that holds the lock until it
/// has become the reader: that is waited for, up to 5 s, and 1 s for any other holder. While it waits it asks
/// `progress` whether to go on. Throws roam::Error naming the holder, and roam::Cancelled.
[[nodiscard]] std::unique_ptr<BuildLock> locked(const Folder& store, const BuildProgress& progress);

/// The folder of a store, made where it is not there, and locked. What builds put there goes again with this, unless
/// keep() was called, it was there before, or there is something that a later build goes on from.
class OutputFolder {
 public:
  /// Holds `store` open from then on. Throws as `locked` and Folder::held, and where the folder that is held has other
  /// things in it than a store: before anything is written.
  OutputFolder(Folder& store, bool through_link, const BuildProgress& progress);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  void keep() { keeps_ = true; }

 private:
  void remove_made_folders() const;

  Folder store_;
  std::vector<MadeFolder> made_;  ///< folders that were not there before, those above the store and its own
  std::set<std::string> there_;   ///< what was in the store before
  std::unique_ptr<BuildLock> lock_;
  bool keeps_ = false;
};

}  // namespace roam::store
