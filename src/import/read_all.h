#pragma once
/// \file
/// Path after path: what reading meshes and reading parts have in common.

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
  std::string tile{};                    ///< empty: all of the path
  std::optional<Georeference> frame{};   ///< that the scene has before anything is read
  std::optional<std::uint64_t> bytes{};  ///< unset: not known yet
};
/// Whole paths.
[[nodiscard]] std::vector<Source> sources(std::span<const std::filesystem::path> paths);

/// Throws roam::Error for options or paths that nothing can be read with.
void check(std::span<const Source> sources, const ImportOptions& options);

/// Checks sources and options, calls `read` once for each source, and finishes the report. `read` answers whether the
/// source gave anything; where it did not, roam::Error says so, except of a tile, which need not be more than a hole
/// in the ground. What matched no ignore pattern is not said of a tile either. Throws what import_scene throws.
void read_all(std::span<const Source> sources, const ImportOptions& options, ImportReport& report,
              const std::function<bool(Reading& reading, std::vector<bool>& matched)>& read);

}  // namespace roam::reader
