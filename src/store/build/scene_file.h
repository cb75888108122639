#pragma once
/// \file
/// A file of a scene, which others may change or replace meanwhile: opening without links, and its hash.

#include <sys/stat.h>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "files/descriptor.h"
#include "import/archive_entry.h"
#include "store/sha256.h"

namespace roam::store {

/// Opens the file at the end of a path without links; `flags` as of open(2). Fails if a link has appeared in the path.
[[nodiscard]] files::Descriptor open_without_links(const std::filesystem::path& real, int flags);
/// The state of an open file of a scene. Throws roam::Error if it is not a regular file.
[[nodiscard]] struct stat state_of(const files::Descriptor& file, const std::filesystem::path& name);
[[noreturn]] void fail_changed(const std::string& name);

/// Hashes a file's bytes. Holes are hashed without reading them.
class FileHash {
 public:
  /// `real`: without links. `tick` is called for each MB. Throws roam::Error for a file that is hardly more than a
  /// hole.
  FileHash(const std::filesystem::path& real, const std::function<void()>& tick);

  /// Device and inode.
  [[nodiscard]] std::pair<std::uint64_t, std::uint64_t> number() const { return {status_.st_dev, status_.st_ino}; }

  /// The digest of the file, or of one entry of it.
  [[nodiscard]] std::string digits(const ArchiveEntry& entry);

 private:
  [[noreturn]] void fail() const;
  void add_hole(std::uint64_t bytes);
  void add_data(off_t from, off_t end);

  std::filesystem::path file_;
  const std::function<void()>& tick_;
  files::Descriptor descriptor_;
  struct stat status_;
  std::vector<std::byte> piece_ = std::vector<std::byte>(1 << 20);
  Sha256 hash_;
};

}  // namespace roam::store
