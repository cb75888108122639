#pragma once
/// \file
/// Files that are whole or not there: written under a temporary name, synced, renamed, the folder synced. And what
/// names and checks them.

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "files/unfinished.h"
#include "roam/store.h"
#include "store/folder.h"
#include "store/sha256.h"

namespace roam::store {

/// Calls a system call again when a signal interrupts it.
template <class Call>
auto again(const Call& call) {
  for (;;) {
    const auto result = call();
    if (result >= 0 || errno != EINTR) return result;
  }
}

/// 64 hexadecimal digits.
[[nodiscard]] std::string sha256(std::span<const std::byte> bytes);
/// Of a file's content; `tick` is called with the bytes of each piece that was read, and may throw.
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& store, const std::string& name,
                                         const std::function<void(std::uint64_t)>& tick = {});
[[nodiscard]] std::uint64_t xxh3(std::span<const std::byte> bytes);

/// A file in the making. Unless commit() was called it is removed again. All throw roam::Error naming the file, the
/// cause (no space, read-only, I/O) and what to do. Interrupted and short writes are gone on with.
class NewFile {
 public:
  /// Beside its final place in the store, under a name that ends with temporary_suffix.
  NewFile(std::filesystem::path store, std::string name);
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
  void rename_to(const std::string& last);
  [[noreturn]] void fail_to_write(int error) const;

  std::filesystem::path store_;
  std::string name_, last_, temporary_;  ///< of these the latter two in `folder_`
  Descriptor folder_, file_;
  files::Unfinished listed_;
  std::uint64_t size_ = 0;
  Sha256 hash_;
};

/// What a build that was ended leaves behind ends with this.
inline constexpr std::string_view temporary_suffix = ".unfinished";

/// Whether NewFile may have written, for a file whose name `is_final` accepts, a temporary file of this name.
[[nodiscard]] bool is_temporary(std::string_view name, const std::function<bool(std::string_view)>& is_final);

void write_file(const std::filesystem::path& store, const std::string& name, std::string_view text);
/// The whole of a file. Throws FileError when it cannot be read or is larger than `limit` (EFBIG).
[[nodiscard]] std::vector<std::byte> read_file(const std::filesystem::path& store, const std::string& name,
                                               std::uint64_t limit);
/// fsync of a folder, whose path is for people.
void sync_folder(int descriptor, const std::filesystem::path& folder);
/// Makes a folder, and those above it, and syncs the one above each that was made. Throws roam::Error.
void make_folder(const std::filesystem::path& folder);

// Where things are in a store.
inline constexpr const char* current_file = "CURRENT";
inline constexpr const char* lock_file = "LOCK";
[[nodiscard]] std::string spare_file(const std::string& hash);     ///< spare/<hash>.json, the manifest once more
[[nodiscard]] std::string pack_file(const std::string& hash);      ///< packs/<hash>.pack
[[nodiscard]] std::string part_file(const std::string& hash);      ///< parts/<hash>.part
[[nodiscard]] std::string manifest_file(const std::string& hash);  ///< manifests/<hash>.json

/// Whether a text is `count` lower-case hexadecimal digits.
[[nodiscard]] bool is_digits(std::string_view text, std::size_t count);
/// Whether a name, in whatever folder, is 64 digits and the extension.
[[nodiscard]] bool is_named_by_hash(std::string_view name, std::string_view extension);

/// A pack in the making: a header, then blobs, each at a multiple of pack_alignment.
class PackWriter {
 public:
  explicit PackWriter(const std::filesystem::path& store);
  /// Returns its offset.
  std::uint64_t add(std::span<const std::byte> blob);
  [[nodiscard]] std::uint64_t size() const { return file_.size(); }
  /// Returns the SHA-256 that names it.
  std::string commit();

 private:
  NewFile file_;
};
inline constexpr std::uint64_t pack_alignment = 8;
inline constexpr std::uint64_t pack_header_bytes = 64;

/// The files of a folder. Keeps the descriptors of the packs that were read from, up to half of what the process may
/// have open.
[[nodiscard]] std::shared_ptr<StoreBytes> files_of(const std::filesystem::path& folder);

/// Another process holds the lock of a store.
class LockedError : public Error {
 public:
  LockedError(const std::string& what, bool ended) : Error(what), holder_ended(ended) {}
  bool holder_ended;  ///< the process that the lock names runs here no more
};

/// One process at a time builds a store: a lock on <store>/LOCK that ends with the process. A file that no build left
/// there is refused.
class BuildLock {
 public:
  /// Tries once. Throws LockedError naming the other process, and FileError.
  explicit BuildLock(const std::filesystem::path& store);
  BuildLock(const BuildLock&) = delete;
  BuildLock& operator=(const BuildLock&) = delete;

 private:
  Descriptor descriptor_;
};

}  // namespace roam::store
