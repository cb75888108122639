#pragma once
/// \file
/// The files that belong to a scene.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

namespace roam {
struct ImportOptions;
}  // namespace roam

namespace roam::reader {

inline constexpr std::size_t longest_path = 4096;  ///< bytes; Linux opens no longer one (PATH_MAX)
/// Most folders in each other below a folder of a scope. The cost of following links grows with the square of it.
inline constexpr int deepest_nesting = 64;

/// The folders and files that a scene may be read from: the folder of the scene's file, or the folder that is the
/// scene, and those that the user allowed. The program and its readers both use it.
///
/// No path outside is accessed, not even to test whether it exists, because it may lead to a network.
struct SceneScope {
  std::filesystem::path scene;                 ///< as its reader receives it: absolute, with no links in the folders
                                               ///< above it
  std::vector<std::filesystem::path> folders;  ///< absolute, without links
  std::vector<std::filesystem::path> files;    ///< absolute, without links

  /// The path with its links followed; unset if it leads outside, or is nested deeper than deepest_nesting. The file
  /// itself need not exist.
  [[nodiscard]] std::optional<std::filesystem::path> resolve(const std::filesystem::path& path) const;
  /// The regular file at `path`, links followed; empty if there is none, or if it lies outside.
  [[nodiscard]] std::filesystem::path find(const std::filesystem::path& path) const;

 private:
  [[nodiscard]] bool holds(const std::filesystem::path& path) const;
};

/// The scope of a scene at `path`. Throws roam::Error for an allowed folder that does not exist, and for a path that is
/// a link if ImportOptions::through_link is false.
[[nodiscard]] SceneScope scope_of(const std::filesystem::path& path, const ImportOptions& options);

}  // namespace roam::reader
