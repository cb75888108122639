#pragma once
/// \file
/// The files of a scene that may be opened.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <unordered_set>

#include "import/reader/archive.h"
#include "import/reader/frame_writer.h"
#include "import/scene_scope.h"

namespace roam::reader {

/// The files of a scene's scope. A reader looks up every file here before it opens it. The sandbox enforces the same
/// for code that does not.
///
/// If the scene is an archive, its entries are the files: paths below that of the archive, which no system call finds.
/// Only read_entry reads them. The members that search entries throw the errors of Archive.
class SceneFiles {
 public:
  /// `frames`: receives reports of files that were looked up, opened or left out.
  /// `known`: see Archive. `opened`: the archive, if another SceneFiles of this scene has opened it.
  SceneFiles(SceneScope scope, FrameWriter& frames, std::optional<ArchiveEntry> known = std::nullopt,
             std::shared_ptr<Archive> opened = nullptr);

  /// See SceneScope. A path out of an archive leads outside.
  [[nodiscard]] std::optional<std::filesystem::path> resolve(const std::filesystem::path& path) const;
  [[nodiscard]] std::filesystem::path find(const std::filesystem::path& path) const;

  /// The same as find(), and reports each path once, with the state of its file. Call it where the triangles depend on
  /// whether there is a file. The tiles of a folder need none: scene_parts() lists them anew. Of an entry it reports
  /// the state of the archive.
  std::filesystem::path look_up(const std::filesystem::path& path);
  /// The same as look_up(), and reports the file as opened. Call it before a file is read.
  std::filesystem::path open(const std::filesystem::path& path);
  /// The archive; null unless it has been opened.
  [[nodiscard]] std::shared_ptr<Archive> opened_archive() const { return archive_; }
  /// Whether the path is that of an entry, whether there is one or not.
  [[nodiscard]] bool is_in_archive(const std::filesystem::path& path) const { return !name_in_archive(path).empty(); }
  /// The entry at a path; unset if there is none.
  [[nodiscard]] std::optional<ArchiveEntry> entry(const std::filesystem::path& path) const;
  /// The same with ArchiveEntry::begin; all zero if there is none.
  [[nodiscard]] ArchiveEntry located_entry(const std::filesystem::path& path) const;
  /// The first bytes of an entry, at most `most`. Unset if there is none, or if it is damaged, which a note says.
  [[nodiscard]] std::optional<std::string> read_entry(const std::filesystem::path& path, std::uint64_t most);
  /// Reports that a library opens files by itself, so that their names are not known.
  void report_unseen();

  /// Reports a reference that leads outside; each path once.
  void leave_out(const std::filesystem::path& path);

  /// Whether any reference led outside.
  [[nodiscard]] bool left_any_out() const { return !left_out_.empty(); }
  /// The first such reference.
  [[nodiscard]] const std::string& first_left_out() const { return first_left_out_; }

 private:
  /// The name of an entry by its path; empty for any other path.
  [[nodiscard]] std::string name_in_archive(const std::filesystem::path& path) const;
  [[nodiscard]] Archive& archive() const;

  SceneScope scope_;
  FrameWriter& frames_;
  std::filesystem::path archive_file_;  ///< without links; empty if the scene is no archive
  std::optional<ArchiveEntry> known_;
  mutable std::shared_ptr<Archive> archive_;                                 ///< opened for the first entry
  std::unordered_set<std::size_t> looked_up_, opened_, left_out_, damaged_;  ///< hashes of paths
  std::string first_left_out_;
};

}  // namespace roam::reader
