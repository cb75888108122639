#pragma once
/// \file
/// The data of a World: the arenas of all tiles, the tree over them, and the names of the meshes.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "index/traverse.h"
#include "roam/world.h"

namespace roam {

/// An array whose elements are not initialized: large arenas are filled by many threads.
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

/// A new number at each call, from any thread; never 0.
[[nodiscard]] std::uint64_t next_revision();

struct WorldData {
  std::uint64_t revision = next_revision();  ///< see World::revision()
  Arena<index::Block> blocks;                ///< the tree over the tiles, then each tile's nodes and leaves
  Arena<index::Tile> tiles;
  Arena<index::FineLeaf> fine;
  Arena<std::uint8_t> ids;
  index::Grid grid;       ///< grid of the tree over the tiles
  Box bounds;             ///< of the source triangles
  Box reach;              ///< bounds, grown by the errors of stored vertices
  double slack = 0.0;     ///< metres: no sweep hits anything farther than this from its body, nor do roundings matter
  bool lossless = false;  ///< see BuildOptions
  WorldStats stats;
  std::vector<std::uint64_t> first;      ///< number of the first triangle of each mesh, followed by the number of all
                                         ///< triangles
  std::vector<std::string> names;        ///< of the meshes
  std::vector<std::uint64_t> user_data;  ///< of the meshes

  /// A view of all of the above for queries. Set when they are complete.
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
  /// The object that a triangle belongs to.
  [[nodiscard]] ObjectId object(std::uint64_t triangle) const {
    if (first.size() == 2) return 0;
    return static_cast<ObjectId>(std::upper_bound(first.begin(), first.end(), triangle) - first.begin()) - 1;
  }
};

}  // namespace roam
