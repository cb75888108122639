#pragma once
/// \file
/// Tiles as the pages of a shown tileset name them.

#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "import/reader/tileset/subtree.h"
#include "import/reader/tileset/tile_json.h"

namespace roam::reader {

/// A tile by its place in its tileset file, and with what the tilesets around that file give it.
struct TileRef {
  std::filesystem::path file;              ///< of the tileset
  std::uint32_t number = 0;                ///< of the tile in it; see TileTree
  std::optional<ImplicitTile> implicit{};  ///< the tile of its implicit tiling; only level, x, y and z count
  glm::dmat4 above{1.0};                   ///< transform of the tile whose content the tileset is, to the scene
  glm::dmat4 earth{1.0};                   ///< transform of Earth-centred coordinates to the scene
  Refine refine = Refine::replace;         ///< of the tile whose content the tileset is
  double error = 0.0;                      ///< the same
  std::vector<std::uint64_t> around{};     ///< hashes of the tilesets around the file
};

/// A page of a tileset.
struct TilePage {
  TileRef tile;
  bool of_children = false;  ///< all children of the tile at once, which replace it; else the tile itself
};

/// The value of DisplayLevel::page; empty if it would be too long.
[[nodiscard]] std::string token_of(const TilePage& page);
/// The page of a token; unset for any other text.
[[nodiscard]] std::optional<TilePage> tile_page_of(std::string_view token);

}  // namespace roam::reader
