#pragma once
/// \file
/// A zip archive whose entries are the files of a scene.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "import/archive_entry.h"
#include "roam/error.h"

namespace roam::reader {

/// Whether a file of this name is read as an archive of 3D Tiles.
[[nodiscard]] bool is_archive_name(const std::filesystem::path& file);

/// Entries are stored or deflated. All members throw roam::Error if the archive or the entry is damaged, MachineFailure
/// if the disk cannot be read, and std::bad_alloc if the directory or an entry does not fit into memory.
///
/// The directory is read when an entry is first searched. An archive is refused as a whole if an entry is encrypted,
/// is compressed in another way, leads out of the archive or has the name of another one, or if the entries together
/// have more bytes than the archive.
class Archive {
 public:
  /// `name`: for messages. `known`: an entry whose place in the directory an earlier reader found, so that the rest of
  /// the directory need not be read for it.
  Archive(const std::filesystem::path& file, std::string name, const std::optional<ArchiveEntry>& known);

  /// The entry of a name, without `begin`: relative, with '/' between folders, and in normal form. Unset if there is
  /// none.
  [[nodiscard]] std::optional<ArchiveEntry> find(const std::string& name);
  /// The first bytes of an entry, at most `most`. A whole entry has the checksum that the archive states.
  [[nodiscard]] std::string read(const ArchiveEntry& entry, std::uint64_t most);
  /// The entry with `begin`.
  [[nodiscard]] ArchiveEntry located(ArchiveEntry entry);

 private:
  void list();
  /// The entry at the current place of the directory, with its name in normal form; empty for a folder.
  [[nodiscard]] std::pair<std::string, ArchiveEntry> current();
  void go_to(const ArchiveEntry& entry);
  void check(int result) const;
  [[nodiscard]] Error damaged(const std::string& what) const;

  struct Close {
    void operator()(void* zip) const;
  };
  std::filesystem::path file_;
  std::string name_;
  std::unique_ptr<void, Close> zip_;
  std::optional<ArchiveEntry> known_;
  bool is_listed_ = false;
  std::unordered_map<std::string, ArchiveEntry> entries_;
};

}  // namespace roam::reader
