#pragma once
/// \file
/// Files that are whole or not there: written under a temporary name, synced, renamed, the folder synced.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "roam/store.h"

namespace roam::store {

/// 64 hexadecimal digits.
[[nodiscard]] std::string sha256(std::span<const std::byte> bytes);
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& file,
                                         const std::function<void(std::uint64_t)>& bytes_done = {});
[[nodiscard]] std::uint64_t xxh3(std::span<const std::byte> bytes);

/// A file in the making. Unless commit() was called it is removed again. All throw roam::Error naming the file, the
/// cause (no space, read-only, I/O) and what to do. EINTR and short writes are dealt with.
class NewFile {
 public:
  /// Beside its final place, under a name that no reader takes for a finished one.
  explicit NewFile(std::filesystem::path final_path);
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void write(std::span<const std::byte> bytes);
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// fsync, rename, fsync of the folder.
  void commit();
  /// The same, named by its content: the final path's folder, SHA-256, the final path's extension. Returns the digits.
  std::string commit_by_hash();

 private:
  struct Hasher;
  std::filesystem::path path_, temporary_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::unique_ptr<Hasher> hasher_;
};

void write_file(const std::filesystem::path& file, std::string_view text);

/// A pack in the making: a header of 64 bytes, then blobs, each at a multiple of 128.
class PackWriter {
 public:
  /// Into `folder`/packs.
  explicit PackWriter(const std::filesystem::path& store);
  /// Returns its offset.
  std::uint64_t add(std::span<const std::byte> blob);
  [[nodiscard]] std::uint64_t size() const { return file_.size(); }
  /// Returns the SHA-256 that names it.
  std::string commit();

 private:
  NewFile file_;
};

/// The files of a folder. Keeps the descriptors of packs that were read from, as many as the process may have.
[[nodiscard]] std::shared_ptr<StoreBytes> files_of(const std::filesystem::path& folder);

/// One process at a time works on a store: flock on <store>/LOCK. Throws roam::Error naming the other process.
class BuildLock {
 public:
  explicit BuildLock(const std::filesystem::path& store);
  ~BuildLock();

 private:
  int descriptor_ = -1;
};

}  // namespace roam::store
