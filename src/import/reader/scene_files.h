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
  /// `frames`: receives reports of files that were opened or left out.
  SceneFiles(SceneScope scope, FrameWriter& frames);

  /// See SceneScope.
  [[nodiscard]] std::optional<std::filesystem::path> resolve(const std::filesystem::path& path) const {
    return scope_.resolve(path);
  }
  [[nodiscard]] std::filesystem::path find(const std::filesystem::path& path) const { return scope_.find(path); }

  /// The same as find(), and reports the file as opened. Call it once for every file that is read.
  std::filesystem::path open(const std::filesystem::path& path);

  /// Reports a reference that leads outside; each path once.
  void leave_out(const std::filesystem::path& path);

  /// Whether any reference led outside.
  [[nodiscard]] bool left_any_out() const { return !left_out_.empty(); }
  /// The first such reference.
  [[nodiscard]] const std::string& first_left_out() const { return first_left_out_; }

 private:
  SceneScope scope_;
  FrameWriter& frames_;
  std::unordered_set<std::size_t> opened_, left_out_;  ///< hashes of paths
  std::string first_left_out_;
};

}  // namespace roam::reader
