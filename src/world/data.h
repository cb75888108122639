#pragma once
/// \file
/// What a World holds: the arenas of all tiles, the tree over them, and what the triangles are called.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "index/traverse.h"
#include "roam/world.h"

namespace roam {

/// An array whose elements are not touched before they are written: large arenas are filled by many threads.
template <class T>
struct Arena {
  std::unique_ptr<T[]> items;
  std::size_t size = 0;

  void allocate(std::size_t count) {
    items = std::make_unique_for_overwrite<T[]>(count);
    size = count;
  }
  [[nodiscard]] std::size_t bytes() const { return size * sizeof(T); }
};

/// Another number at each call, from any thread; never 0.
[[nodiscard]] std::uint64_t next_revision();

struct WorldData {
  std::uint64_t revision = next_revision();  ///< as World::revision() says
  Arena<index::Block> blocks;                ///< the tree over the tiles, then each tile's nodes and leaves
  Arena<index::Tile> tiles;
  Arena<index::FineLeaf> fine;
  Arena<std::uint8_t> ids;
  index::Grid grid;       ///< of the tree over the tiles
  Box bounds;             ///< of the source triangles
  Box reach;              ///< bounds, grown by what stored vertices may lie off
  bool lossless = false;  ///< as BuildOptions says
  WorldStats stats;
  std::vector<std::uint64_t> first;      ///< the number of the first triangle of each mesh, and the count of all
  std::vector<std::string> names;        ///< of the meshes
  std::vector<std::uint64_t> user_data;  ///< of the meshes

  /// Everything above as queries see it. Set when that is complete.
  index::Index index;

  [[nodiscard]] index::Index view() const {
    return {.top = blocks.items.get(),
            .tiles = tiles.items.get(),
            .blocks = blocks.items.get(),
            .fine = reinterpret_cast<const std::byte*>(fine.items.get()),
            .ids = ids.items.get(),
            .grid = grid,
            .absent = nullptr};
  }
  /// The object of one of its triangles.
  [[nodiscard]] ObjectId object(std::uint64_t triangle) const {
    if (first.size() == 2) return 0;
    return static_cast<ObjectId>(std::upper_bound(first.begin(), first.end(), triangle) - first.begin()) - 1;
  }
};

}  // namespace roam
