#pragma once
/// \file
/// The outline of a tileset: the contents that are its finest level of detail, without reading them.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "import/reader/mesh_sink.h"
#include "import/reader/scene_files.h"
#include "import/reader/tileset/tile_content.h"
#include "roam/import.h"

namespace roam::reader {

/// A content to be read: a file, and where its tile lies.
struct TileContent {
  std::filesystem::path file;
  TilePlace place;
};

/// The content as text, which is the name of a part (ImportOptions are no part of it). Files in `folder` are relative
/// to it, so that a copy of the scene has the same text.
[[nodiscard]] std::string token_of(const TileContent& content, const std::filesystem::path& folder);
/// The content of such a text; unset for any other text.
[[nodiscard]] std::optional<TileContent> content_of(std::string_view token, const std::filesystem::path& folder);

struct Outline {
  std::vector<TileContent> contents;         ///< in the order of the tileset; each once at a place
  std::vector<std::filesystem::path> files;  ///< tilesets and subtrees that were read
  std::uint64_t missing = 0;                 ///< contents, tilesets and subtrees that are absent or damaged
  std::string first_missing;
  std::uint64_t stand_ins = 0;  ///< contents that stand in for finer ones
  std::uint64_t points = 0;     ///< contents that are point clouds
  std::vector<std::string> point_files;
  /// Where the tiles are moved to, if they have Earth-centred coordinates.
  std::optional<Georeference> georeference;
  std::vector<std::string> notes;  ///< about that
};

/// Reads the tileset and all that it names except contents. A content is in the outline if it is there, and if no
/// complete set of finer contents replaces it. Reports missing files to `sink`. Throws roam::Error if the tileset is
/// damaged, or nested too deep.
[[nodiscard]] Outline outline_of(const std::filesystem::path& tileset, SceneFiles& files, MeshSink& sink,
                                 const ReadingSettings& settings);

}  // namespace roam::reader
