#pragma once
/// \file
/// Whether a part of a scene is what it was.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "roam/import.h"
#include "roam/store.h"
#include "store/folder.h"

namespace roam::store {

/// How a scene is read, as text: the same text, the same triangles from the same files.
[[nodiscard]] std::string text_of(const ImportOptions& options);
/// The reverse: sets what the text says. Throws roam::Error for what no text_of gives.
void read_as(const std::string& text, ImportOptions& options);

/// Knows the content of the scene's files by their SHA-256. A file whose size and time of change (ctime) are those of
/// the last time is not read again, unless it was changed so shortly before that the time cannot tell.
///
/// The fingerprint of a part depends on names, contents and options, not on times: a copy of the scene has the same.
class Sources {
 public:
  /// It is remembered in the folder of a store. What is damaged there, or was not remembered with the key, is
  /// forgotten.
  Sources(Folder store, const std::optional<StoreKey>& key);

  /// Looks at all files of the parts, on all threads of the arena that it is called in. `tick` may throw; it is called
  /// for each MB that is hashed. A file that several names lead to is hashed once, holes are not read. Only regular
  /// files of the parts' scenes and of the folders in `allow` are opened, whatever takes their places meanwhile. Throws
  /// roam::Error for any other, and for a file that is hardly more than a hole.
  void look(const std::vector<ScenePart>& parts, std::span<const std::filesystem::path> allow,
            const std::function<void()>& tick);
  /// Of a part that was looked at.
  [[nodiscard]] std::string fingerprint(const ScenePart& part, const std::string& options) const;
  /// Throws roam::Error when a file of the part is not what it was when it was looked at.
  void check_unchanged(const ScenePart& part) const;
  void save() const;

 private:
  struct Seen {
    std::uint64_t size = 0;
    std::int64_t changed_ns = 0;  ///< of its status: nobody can set that back
    std::string hash;             ///< SHA-256
    bool settled = false;         ///< it was changed long before it was looked at
    bool operator==(const Seen&) const = default;
  };
  using Number = std::pair<std::uint64_t, std::uint64_t>;  ///< of a file, whatever its names: device and inode
  /// `real`: without links.
  static Seen status(const std::filesystem::path& real, Number* number = nullptr);

  Folder store_;
  std::optional<StoreKey> key_;
  std::map<std::string, Seen> known_, seen_;
  std::map<std::string, std::filesystem::path> linked_;  ///< where names lead that have links in them
};

}  // namespace roam::store
