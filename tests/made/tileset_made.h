#pragma once
/// \file
/// Tilesets of many tiles.

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "gltf_made.h"

namespace roam::test {

/// A square floor as a quadtree: each tile has the same number of quads, so that each level is twice as fine.
struct MadeQuadtree {
  int levels = 4;
  double side = 256.0;      ///< metres
  std::uint32_t quads = 8;  ///< along a side of a tile
  double error = 16.0;      ///< metres, of the coarsest level; each is half of the one above
  const char* refine = "REPLACE";
  /// Whether only the finest level has contents, all of them below one tile.
  bool only_finest = false;

  [[nodiscard]] int tiles() const {
    int all = 0;
    for (int level = 0; level < levels; ++level) all += 1 << 2 * level;
    return all;
  }
  /// Writes tileset.json and its contents.
  std::filesystem::path write(const std::filesystem::path& folder) const {
    std::filesystem::create_directories(folder);
    for (int level = 0; level < levels; ++level) {
      const auto side_here = static_cast<float>(std::ldexp(side, -level));
      save(folder / (std::to_string(level) + ".b3dm"), made_tile("b3dm", MadeGrid(quads, 0, side_here).gltf().glb()));
    }
    Json root = tile(folder, 0, 0, 0);
    if (only_finest) {
      Json leaves = Json::array();
      for (int x = 0; x < 1 << (levels - 1); ++x) {
        for (int y = 0; y < 1 << (levels - 1); ++y) leaves.push_back(tile(folder, levels - 1, x, y));
      }
      root["children"] = leaves;
      root.erase("content");
    }
    return save(folder / "tileset.json", made_tileset(root));
  }
  /// The file of a tile's content.
  [[nodiscard]] static std::string file(int level, int x, int y) {
    return std::to_string(level) + "." + std::to_string(x) + "." + std::to_string(y) + ".b3dm";
  }

 private:
  static std::filesystem::path save(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }
  [[nodiscard]] Json tile(const std::filesystem::path& folder, int level, int x, int y) const {
    const double here = std::ldexp(side, -level), half = 0.5 * here;
    std::filesystem::copy_file(folder / (std::to_string(level) + ".b3dm"), folder / file(level, x, y),
                               std::filesystem::copy_options::overwrite_existing);
    const bool is_last = level + 1 == levels;
    Json made{{"boundingVolume", {{"box", {half, -half, 0, half, 0, 0, 0, half, 0, 0, 0, 1}}}},
              {"geometricError", is_last ? 0.0 : std::ldexp(error, -level)},
              {"refine", refine},
              {"content", {{"uri", file(level, x, y)}}}};
    // Relative to the tile above. The content turns y up, so that a floor extends to -y.
    const bool alone = level == 0 || only_finest;
    made["transform"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, here * (alone ? x : x % 2), -here * (alone ? y : y % 2),
                         0, 1};
    for (int i = 0; i < 4 && !is_last && !only_finest; ++i) {
      made["children"].push_back(tile(folder, level + 1, 2 * x + i % 2, 2 * y + i / 2));
    }
    return made;
  }
};

}  // namespace roam::test
