#pragma once
/// \file
/// The files of a tileset's contents: whether they are there, and of which kind.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "import/reader/scene_files.h"

namespace roam::reader {

/// Looks at files, but reads only their first bytes. A tileset names very many files in few folders, so folders are
/// remembered.
class TileContents {
 public:
  explicit TileContents(SceneFiles& files) : files_(files) {}

  /// The path that a URI names, as named_file. It need not exist. Empty for a URI with a scheme.
  [[nodiscard]] std::filesystem::path place(const std::filesystem::path& folder, const std::string& uri);
  /// The regular file at a path, without links; empty if there is none. A path out of the scene is left out.
  [[nodiscard]] std::filesystem::path find(const std::filesystem::path& path);

  /// A content that is no file, is cut off, or begins like no content is missing.
  enum class State { missing, mesh, points, tileset };
  [[nodiscard]] State state_of(const std::filesystem::path& path);

 private:
  struct Start {
    std::string bytes;  ///< the first ones, for kind_of
    std::uint64_t size = 0;
  };
  /// That of a file from find(); unset if it cannot be read.
  [[nodiscard]] std::optional<Start> start_of(const std::filesystem::path& file);

  SceneFiles& files_;
  std::map<std::filesystem::path, std::optional<std::filesystem::path>> folders_;  ///< without links; unset: outside
};

}  // namespace roam::reader
