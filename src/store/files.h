#pragma once
/// \file
/// Files that are either whole or absent; their names and their checks.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "files/whole_file.h"
#include "store/bytes.h"
#include "store/folder.h"
#include "store/sha256.h"

namespace roam::store {

using files::again;
using files::is_temporary;
using files::sync_folder;

/// 64 hexadecimal digits.
[[nodiscard]] std::string sha256(std::span<const std::byte> bytes);
/// SHA-256 of a file's content. `tick` is called with the size of each piece read, and may throw.
[[nodiscard]] std::string sha256_of_file(const Folder& store, const std::string& name,
                                         const std::function<void(std::uint64_t)>& tick = {});
/// The same of many files that do not change meanwhile. A file with several names (hard links) is hashed once.
/// Thread-safe.
class FileHashes {
 public:
  explicit FileHashes(Folder store) : store_(std::move(store)) {}
  [[nodiscard]] std::string sha256(const std::string& name, const std::function<void(std::uint64_t)>& tick = {});

 private:
  using Number = std::pair<std::uint64_t, std::uint64_t>;  ///< device and inode

  Folder store_;
  std::mutex mutex_;
  std::map<Number, std::shared_future<std::string>> hashes_;
};
[[nodiscard]] std::uint64_t xxh3(std::span<const std::byte> bytes);

/// A file of a store being built: a WholeFile that is hashed while it is written. Throws FileError.
class NewFile {
 public:
  NewFile(const Folder& store, const std::string& name);

  void write(std::span<const std::byte> bytes);
  [[nodiscard]] std::uint64_t size() const { return size_; }
  void commit();
  /// Commits under a name made of the final path's folder, the SHA-256 and the final path's extension. Returns the
  /// digits.
  std::string commit_by_hash();
  /// Commits as commit_by_hash if the SHA-256 is `digits`. Else returns false, and nothing is committed.
  [[nodiscard]] bool commit_if_hash_is(const std::string& digits);

 private:
  void commit_as(const std::string& last);

  Folder store_;
  std::string name_;
  files::WholeFile file_;
  std::uint64_t size_ = 0;
  Sha256 hash_;
};

void write_file(const Folder& store, const std::string& name, std::string_view text);
/// The content of a file. Throws FileError if it cannot be read or is larger than `limit` (EFBIG).
[[nodiscard]] std::vector<std::byte> read_file(const Folder& store, const std::string& name, std::uint64_t limit);

/// Why a file is refused that has ranges without space on the disk.
inline constexpr const char* mostly_holes =
    "most of it is holes, which take no space on the disk and which no store has";

// Names of files in a store.
inline constexpr const char* current_file = "CURRENT";
inline constexpr const char* lock_file = "LOCK";
[[nodiscard]] std::string spare_file(const std::string& hash);     ///< spare/<hash>.json, a second copy of the manifest
[[nodiscard]] std::string pack_file(const std::string& hash);      ///< packs/<hash>.pack
[[nodiscard]] std::string part_file(const std::string& hash);      ///< parts/<hash>.part
[[nodiscard]] std::string manifest_file(const std::string& hash);  ///< manifests/<hash>.json

/// Whether a text is `count` lower-case hexadecimal digits.
[[nodiscard]] bool is_digits(std::string_view text, std::size_t count);
/// Whether a name, in any folder, consists of 64 digits and the extension.
[[nodiscard]] bool is_named_by_hash(std::string_view name, std::string_view extension);

/// A pack being built: a header, then blobs, each at a multiple of pack_alignment.
class PackWriter {
 public:
  explicit PackWriter(const Folder& store);
  /// Appends a blob. Returns its offset.
  std::uint64_t add(std::span<const std::byte> blob);
  [[nodiscard]] std::uint64_t size() const { return file_.size(); }
  /// Returns the SHA-256 that is the pack's name.
  std::string commit();

 private:
  NewFile file_;
};
inline constexpr std::uint64_t pack_alignment = 8;
inline constexpr std::uint64_t pack_header_bytes = 64;

/// The files of a folder. Keeps the descriptors of packs open after the first read, up to half of the process's limit.
[[nodiscard]] std::shared_ptr<StoreBytes> files_of(const Folder& folder);

/// Thrown when another process holds the lock of a store.
class LockedError : public Error {
 public:
  LockedError(const std::string& store, const std::string& what, bool ended)
      : Error(store, what), holder_ended(ended) {}
  bool holder_ended;  ///< the process named in the lock no longer runs on this machine
};

/// The right to build a store, held by one process at a time: a lock on <store>/LOCK that ends with the process. A file
/// there that no build has left is refused.
class BuildLock {
 public:
  /// Tries once. Throws LockedError, which names the other process, and FileError.
  explicit BuildLock(const Folder& store);
  BuildLock(const BuildLock&) = delete;
  BuildLock& operator=(const BuildLock&) = delete;

 private:
  Descriptor descriptor_;
};

}  // namespace roam::store
