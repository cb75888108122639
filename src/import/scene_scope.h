#pragma once
/// \file
/// Which files belong to a scene.

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace roam::reader {

/// The folders and files that a scene may be read from: the folder of the scene's file, or the folder that is the
/// scene, and those that the user allowed. Both the program and its readers go by it.
///
/// Nothing outside is looked at, not even for whether it is there: a path may lead to a network.
struct SceneScope {
  std::filesystem::path scene;                 ///< as its reader gets it: absolute, the folders above it without links
  std::vector<std::filesystem::path> folders;  ///< absolute, without links
  std::vector<std::filesystem::path> files;    ///< absolute, without links

  /// Where a path leads, links followed; unset when it leads outside. The file itself need not be there.
  [[nodiscard]] std::optional<std::filesystem::path> resolve(const std::filesystem::path& path) const;
  /// The regular file at `path`, links followed; empty when there is none, or when it lies outside.
  [[nodiscard]] std::filesystem::path find(const std::filesystem::path& path) const;

 private:
  [[nodiscard]] bool holds(const std::filesystem::path& path) const;
};

/// A path that the user named: absolute, and the folders above its last part without links.
[[nodiscard]] std::filesystem::path without_links_above(const std::filesystem::path& path);

/// The scope of a scene that the user names by `path`. Throws roam::Error for an allowed folder that is not there.
[[nodiscard]] SceneScope scope_of(const std::filesystem::path& path, std::span<const std::filesystem::path> allowed);

}  // namespace roam::reader
