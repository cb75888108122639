#pragma once
/// \file
/// A cache on the disk, of one file with a fixed size, which several processes may share. The newest entries overwrite
/// the oldest. A crash or a power cut loses entries at most: each is read with its checksum.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "files/descriptor.h"

namespace roam::web {

class DiskCache {
 public:
  static constexpr std::uint64_t least_bytes = 4 << 20;
  static constexpr std::size_t key_bytes = 64;

  /// Opens the file, or makes it and its folder, for its owner alone. A file of another size becomes empty. Throws
  /// roam::Error if it cannot be used or others may write to it, or `bytes` is less than least_bytes. If another
  /// process holds the file's lock, a new cache or one of another size is not made: this object then keeps nothing.
  DiskCache(const std::filesystem::path& file, std::uint64_t bytes);

  // Keys have key_bytes characters. Any thread may call these. They throw nothing: an entry that cannot be read is not
  // there, and one that cannot be written is not kept.

  /// Whether there is an entry of this size; it is copied then.
  [[nodiscard]] bool find(std::string_view key, std::span<std::byte> out) noexcept;
  /// An entry of any size up to `limit`.
  [[nodiscard]] std::optional<std::vector<std::byte>> find(std::string_view key, std::uint64_t limit) noexcept;
  /// Keeps an entry, or makes one young that is about to be overwritten.
  void keep(std::string_view key, std::span<const std::byte> bytes) noexcept;

 private:
  struct Header;
  struct Slot;
  /// Makes the file a cache of this size unless it is one. False: its lock is held.
  [[nodiscard]] bool is_made(const std::filesystem::path& file, std::uint64_t bytes) const;
  [[nodiscard]] bool read(Header& header) const;
  [[nodiscard]] bool read(const Header& header, std::string_view key, std::span<Slot> slots) const;
  [[nodiscard]] bool read(const Header& header, const Slot& slot, std::span<std::byte> out) const;
  [[nodiscard]] bool find(const Header& header, std::string_view key, Slot& found) const;
  void write(std::string_view key, std::span<const std::byte> bytes);

  files::Descriptor file_;
  std::mutex mutex_;  ///< for writing, with the lock of the file
};

}  // namespace roam::web
