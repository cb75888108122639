#include "import/reader/tileset/tile_tree.h"

#include <cmath>
#include <limits>
#include <utility>

#include "roam/error.h"

namespace roam::reader {
namespace {

/// Adds a tile and all below. Their depth is that of the JSON, which is limited.
std::uint32_t add(TileTree& tree, const Json& tile, std::uint32_t parent) {
  const std::string place = tree.file.string();
  if (tree.tiles.size() == std::numeric_limits<std::uint32_t>::max())
    throw Error(place, "it has more than 2^32 tiles.");
  const auto number = static_cast<std::uint32_t>(tree.tiles.size());
  TreeTile added{parent, nullptr, TileVolume(tile), {}, refine_of(tile), uris_of(tile), {}, nullptr};
  if (!member(tile, "transform").is_null()) added.transform = std::make_unique<glm::dmat4>(transform_of(tile, place));
  if (const double error = reader::number(member(tile, "geometricError"), -1.0); error >= 0.0) added.error = error;
  if (auto tiling = ImplicitTiling::of(tile, place)) {
    tiling->contents = std::exchange(added.uris, {});
    added.tiling = std::make_unique<ImplicitTiling>(std::move(*tiling));
  }
  tree.tiles.push_back(std::move(added));
  if (tree.tiles[number].tiling != nullptr) return number;
  const Json& children = member(tile, "children");
  if (!children.is_array()) return number;
  for (const Json& child : children) {
    const std::uint32_t below = add(tree, child, number);
    tree.tiles[number].children.push_back(below);
  }
  return number;
}

}  // namespace

TileTree tree_of(const Json& tileset, const std::filesystem::path& file) {
  TileTree tree{file, gltf_up_of(tileset), {}};
  static_cast<void>(add(tree, member(tileset, "root"), 0));
  return tree;
}

}  // namespace roam::reader
