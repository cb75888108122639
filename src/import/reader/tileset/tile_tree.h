#pragma once
/// \file
/// A tileset file as a list of its tiles, which takes less memory than its JSON.

#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "import/reader/json.h"
#include "import/reader/tileset/subtree.h"
#include "import/reader/tileset/tile_json.h"
#include "import/reader/tileset/tile_volume.h"
#include "roam/scene_frame.h"

namespace roam::reader {

struct TreeTile {
  std::uint32_t parent = 0;                      ///< number; of the root: its own
  std::unique_ptr<const glm::dmat4> transform;   ///< null: none
  TileVolume volume;                             ///< may be none
  std::optional<double> error;                   ///< geometric error; unset: as its parent's
  std::optional<Refine> refine;                  ///< unset: as its parent's
  std::vector<std::string> uris;                 ///< of its contents
  std::vector<std::uint32_t> children;           ///< numbers
  std::unique_ptr<const ImplicitTiling> tiling;  ///< null: an explicit tile; `contents` are its URIs
};

struct TileTree {
  std::filesystem::path file;
  UpAxis gltf_up = UpAxis::y;
  std::vector<TreeTile> tiles;  ///< numbered in the order of the file; the root is 0
};

/// The tiles of the values of a tileset `file`. Throws roam::Error if a tile is damaged.
[[nodiscard]] TileTree tree_of(const Json& tileset, const std::filesystem::path& file);

}  // namespace roam::reader
