#pragma once
/// \file
/// Fingerprints of the parts of a scene, to find those that have changed.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "import/parts.h"
#include "import/scene_scope.h"
#include "roam/store.h"
#include "store/build/references.h"
#include "store/folder.h"
#include "store/json_reader.h"

namespace roam::store {

/// The import options as text: the same text gives the same triangles from the same files.
[[nodiscard]] std::string text_of(const ImportOptions& options);
/// Up axis, unit and ignored objects in such a text; the defaults where it has none. Accepts any text.
[[nodiscard]] ImportOptions stated_in(const std::string& text);
/// The reverse: sets `options` from the text. Throws roam::Error for a text that text_of did not write.
void read_as(const std::string& text, ImportOptions& options);

/// The state of a file of the scene, by which a builder sees that it has changed.
struct SceneFile {
  std::uint64_t size = 0;
  std::int64_t changed_ns = 0;  ///< ctime: no program can set it back
  std::string hash;             ///< SHA-256
  bool operator==(const SceneFile&) const = default;
};
using SceneFiles = std::map<std::string, SceneFile>;  ///< by absolute path
[[nodiscard]] Json json_of(const SceneFiles& files);
/// The reverse. Leaves out what is no such file.
[[nodiscard]] SceneFiles scene_files_of(const Json& json);

/// The content of the scene's files, by their SHA-256. A file is not read again if its size and time of change (ctime)
/// are those of the last time. It is read again if that change was too recent for the file system's clock.
///
/// The fingerprint of a part depends on names, contents and options, not on times: a copy of the scene has the same
/// one. It covers the files that scene_parts() lists and the references, with those that are absent. An entry of an
/// archive is a file: its hash is that of its bytes in the archive, and the time is that of the archive.
///
/// Thread-safe, except save() and know().
class Sources {
 public:
  /// The results are saved in the folder of the store. Damaged results, or those without a code of the key, are
  /// ignored.
  Sources(Folder store, const std::optional<StoreKey>& key, const ImportOptions& import);

  /// Adds files that other processes have examined, perhaps on other machines.
  void know(SceneFiles&& files);

  /// The part with these references. None if a name leads out of the scene.
  [[nodiscard]] std::optional<SourcePart> with_references(const ScenePart& part, const std::vector<std::string>& names);
  /// The scope of a scene.
  [[nodiscard]] const reader::SceneScope& scope(const std::filesystem::path& path);

  /// Examines all files of the parts that it has not examined before, on all threads of the calling arena. Calls
  /// `tick`, which may throw, for each MB hashed. A file with several names is hashed once; holes are not read. Opens
  /// only regular files of the parts' scenes and of ImportOptions::allow, even if other files take their places
  /// meanwhile. Any other reference counts as absent. Throws roam::Error for any other listed file, and for a file that
  /// is hardly more than a hole.
  void look(const std::vector<SourcePart>& parts, const std::function<void()>& tick);
  /// The fingerprint of a part that look() has examined.
  [[nodiscard]] std::string fingerprint(const SourcePart& part, const std::string& options) const;
  /// Throws roam::Error if a file of the part has changed since look(), or was not the same when its reader looked it
  /// up.
  void check_unchanged(const SourcePart& part, const LookUps& look_ups) const;
  /// The files of a part that look() has examined, except those that must be read again: they changed too recently.
  [[nodiscard]] SceneFiles files(const SourcePart& part) const;
  void save() const;

 private:
  struct Seen : SceneFile {
    bool time_is_conclusive = false;  ///< it had changed long before it was examined
    bool is_absent = false;
    [[nodiscard]] bool is_settled() const { return time_is_conclusive && !is_absent; }
  };
  using Number = std::pair<std::uint64_t, std::uint64_t>;  ///< of a file, independent of its names: device and inode
  /// `real`: without links.
  static Seen status(const std::filesystem::path& real, Number* number = nullptr);
  /// Throws roam::Error if the file has changed since look(). The mutex is held.
  void check_unchanged(const std::string& name) const;

  Folder store_;
  std::optional<StoreKey> key_;
  ImportOptions import_;
  mutable std::mutex mutex_;  ///< of all below
  std::map<std::filesystem::path, reader::SceneScope> scopes_;
  SceneFiles known_;
  bool is_saved_ = true;  ///< all of `known_` is in the file
  std::map<std::string, Seen> seen_;
  std::map<std::string, std::filesystem::path> linked_;  ///< targets of names that contain links
};

}  // namespace roam::store
