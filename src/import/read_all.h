#pragma once
/// \file
/// The loop over the paths of a scene, shared by reading meshes and reading parts.

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "import/reading.h"
#include "roam/import.h"

namespace roam::reader {

/// A path, or one tile of it.
struct Source {
  std::filesystem::path path;
  std::string tile{};                    ///< empty: the whole path
  std::optional<Georeference> frame{};   ///< the frame of the scene, if set before reading
  std::optional<std::uint64_t> bytes{};  ///< unset: not known yet
  std::optional<ArchiveEntry> entry{};   ///< the tile's, in an archive
};
/// One source for each whole path.
[[nodiscard]] std::vector<Source> sources(std::span<const std::filesystem::path> paths);

/// Throws roam::Error for invalid options or paths.
void check(std::span<const Source> sources, const ImportOptions& options);

/// Checks sources and options, calls `read` once for each source, and finishes the report. `read` returns whether the
/// source gave anything. If it did not, throws roam::Error, except for a tile, which may be a hole in the ground.
/// Ignore patterns without a match are not reported for a tile either. Throws what import_scene throws.
void read_all(std::span<const Source> sources, const ImportOptions& options, ImportReport& report,
              const std::function<bool(Reading& reading, std::vector<bool>& matched)>& read);

}  // namespace roam::reader
