#pragma once
/// \file
/// A tileset by its levels of detail: its tiles as pages, which are read on demand.
///
/// A tile with a content and finer tiles is one node of pages (DisplayPages, by error). Below the allowed error it
/// shows the content. Above it, tiles that replace it come together, as one page, so that neither a hole nor a surface
/// twice is seen while they are read; tiles that are added to it come one by one. A tile without a content is passed
/// through. Where a tile that should replace another is missing, the page fails, and the coarser one stays.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string_view>

#include "import/reader/mesh_sink.h"
#include "import/reader/scene_files.h"
#include "import/reader/tileset/tile_ref.h"
#include "import/reader/tileset/tile_tree.h"

namespace roam::reader {

/// Sends one part with the root of a tileset as a page. Returns false, and sends nothing, for a tileset of a single
/// tile, or without bounds: it is better read whole. Throws roam::Error if the tileset is damaged. `sink` must have
/// parts.
[[nodiscard]] bool hand_on_pages(const std::filesystem::path& tileset, SceneFiles& files, MeshSink& sink,
                                 const ReadingSettings& settings);

/// The tilesets that a reader of pages keeps, so that their files are read once.
class TileTrees {
 public:
  /// The tiles of a file. Throws roam::Error if it cannot be read. Stays valid until shrink().
  const TileTree& of(const std::filesystem::path& file, SceneFiles& files, MeshSink& sink);
  /// Forgets all tilesets but the last one if there are too many tiles.
  void shrink();

 private:
  std::map<std::filesystem::path, TileTree> trees_;
  std::filesystem::path last_;
  std::size_t tiles_ = 0;
};

/// Reads a page into the page of the sink's parts (PartPool::begin_page). Contents that are missing or damaged are
/// counted. Throws roam::Error if one that should replace a coarser one is missing, or if nothing is there.
void read_tile_page(const TilePage& page, SceneFiles& files, MeshSink& sink, TileTrees& trees);

}  // namespace roam::reader
