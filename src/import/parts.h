#pragma once
/// \file
/// The parts of a scene, for builds of stores that read only those that changed.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "import/archive_entry.h"
#include "roam/import.h"

namespace roam {
namespace reader {
class SceneBudget;
}

/// A part of a scene that can be read alone: a file, one tile (Data/Tile_x/Tile_x.osgb and its pages) of a folder of
/// photogrammetry, or the content of one tile of 3D Tiles. A tileset's first part has no triangles, only what its
/// report says of the tileset as a whole. All parts in order are the scene.
struct ScenePart {
  std::string name;                     ///< unique; does not depend on where the scene lies; UTF-8, other bytes as %XX
  std::filesystem::path path;           ///< as passed to scene_parts
  std::string tile;                     ///< name of the tile in its folder, or its place in its tileset; empty for a
                                        ///< file
  std::optional<Georeference> frame{};  ///< of the first folder, into which this part is placed
  /// Files of the part: absolute, sorted. For a file that file; it may refer to others. For a tile all files of its
  /// folder, then metadata.xml; empty if the tile is missing.
  std::vector<std::filesystem::path> files{};
  /// If the scene is an archive: where each of `files`, whose path is then below that of the archive, lies in it.
  std::vector<ArchiveEntry> entries{};
  std::uint64_t bytes = 0;  ///< of these files; of entries, packed
};

/// The parts of a scene, in the order of the paths. Within a folder, tiles whose root is missing come first, then the
/// others by name. Reads folders, metadata.xml, tilesets and subtrees, but no other scene file. Throws roam::Error for
/// missing paths, unknown formats and folders in different reference systems; roam::Cancelled if `progress` returns
/// false.
[[nodiscard]] std::vector<ScenePart> scene_parts(std::span<const std::filesystem::path> paths,
                                                 const ImportOptions& options = {});

/// A file that a reader looked for in the scene, and its state just before the reader could open it.
struct FileLookUp {
  std::filesystem::path file;   ///< absolute, without "..", perhaps with links; empty: the reader's library opens files
                                ///< that are not reported
  bool found = false;           ///< whether it is a regular file of the scene; for an entry of an archive, there or
                                ///< not, this and the rest are those of the archive
  std::uint64_t bytes = 0;      ///< its size
  std::int64_t changed_ns = 0;  ///< time of change (ctime), ns since 1970
};
using LookUpSink = std::function<void(const FileLookUp&)>;

/// Reads one part, with a reader of its own. A tile that is missing or has no triangle gives no piece and no error; the
/// report counts the missing page. For a tile, unmatched patterns of ImportOptions::ignore are not reported.
/// `look_ups` receives each path that the reader looked up, as the reader states it; exceptions pass through.
/// `scene`: a budget of all parts, which may be read at once; without it the part has one of its own.
ImportReport stream_part(const ScenePart& part, const ImportOptions& options, const PieceSink& sink,
                         const LookUpSink& look_ups = {}, reader::SceneBudget* scene = nullptr);

}  // namespace roam
