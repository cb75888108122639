#pragma once
/// \file
/// Which files of a scene may be opened.

#include <filesystem>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "import/reader/frame_writer.h"

namespace roam::reader {

/// The files below the scene's folders, and those that the user named. Every file that a reader opens is looked up here
/// first; the sandbox enforces the same for code that does not.
///
/// Nothing outside is looked at, not even for whether it is there: a path may lead to a network.
class SceneFiles {
 public:
  /// `folders` and `files` are absolute and without links. `frames`: where is reported what is opened and left out.
  SceneFiles(std::vector<std::filesystem::path> folders, std::vector<std::filesystem::path> files, FrameWriter& frames);

  /// Where a path leads, links followed; unset when it leads outside. The file itself need not be there.
  [[nodiscard]] std::optional<std::filesystem::path> resolve(const std::filesystem::path& path) const;

  /// The regular file at `path`; empty when there is none, or when it lies outside.
  [[nodiscard]] std::filesystem::path find(const std::filesystem::path& path) const;

  /// The same for a file that is opened now, which is reported. Call it once for every file that is read.
  std::filesystem::path open(const std::filesystem::path& path);

  /// Reports a reference that leads outside, once.
  void leave_out(const std::filesystem::path& path);

  /// Whether any reference led outside.
  [[nodiscard]] bool left_any_out() const { return !left_out_.empty(); }
  /// The first of them.
  [[nodiscard]] const std::string& first_left_out() const { return first_left_out_; }

 private:
  [[nodiscard]] bool holds(const std::filesystem::path& path) const;

  std::vector<std::filesystem::path> folders_;
  std::vector<std::filesystem::path> files_;
  FrameWriter& frames_;
  std::unordered_set<std::size_t> opened_, left_out_;  ///< hashes of paths
  std::string first_left_out_;
};

}  // namespace roam::reader
