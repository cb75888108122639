#pragma once
/// \file
/// The files of a scene that may be opened.

#include <filesystem>
#include <optional>
#include <string>
#include <unordered_set>

#include "import/reader/frame_writer.h"
#include "import/scene_scope.h"

namespace roam::reader {

/// The files of a scene's scope. A reader looks up every file here before it opens it. The sandbox enforces the same
/// for code that does not.
class SceneFiles {
 public:
  /// `frames`: receives reports of files that were looked up, opened or left out.
  SceneFiles(SceneScope scope, FrameWriter& frames);

  /// See SceneScope.
  [[nodiscard]] std::optional<std::filesystem::path> resolve(const std::filesystem::path& path) const {
    return scope_.resolve(path);
  }
  [[nodiscard]] std::filesystem::path find(const std::filesystem::path& path) const { return scope_.find(path); }

  /// The same as find(), and reports each path once, with the state of its file. Call it where the triangles depend on
  /// whether there is a file. The tiles of a folder need none: scene_parts() lists them anew.
  std::filesystem::path look_up(const std::filesystem::path& path);
  /// The same as look_up(), and reports the file as opened. Call it before a file is read.
  std::filesystem::path open(const std::filesystem::path& path);
  /// Reports that a library opens files by itself, so that their names are not known.
  void report_unseen();

  /// Reports a reference that leads outside; each path once.
  void leave_out(const std::filesystem::path& path);

  /// Whether any reference led outside.
  [[nodiscard]] bool left_any_out() const { return !left_out_.empty(); }
  /// The first such reference.
  [[nodiscard]] const std::string& first_left_out() const { return first_left_out_; }

 private:
  SceneScope scope_;
  FrameWriter& frames_;
  std::unordered_set<std::size_t> looked_up_, opened_, left_out_;  ///< hashes of paths
  std::string first_left_out_;
};

}  // namespace roam::reader
