#pragma once
/// \file
/// What reports have read of a store: a little of it, so that they need not read the same again.

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "store/opened.h"
#include "store/part.h"
#include "store/tile_reader.h"

namespace roam {

struct Store::State::Recent {
  explicit Recent(const State& state) : store(state), reader(state) {}

  /// Bytes that are kept at most. The largest page and the largest tile's numbers fit together.
  static constexpr std::size_t most = 1U << 20;

  /// The numbers of a tile's triangles. Throws what TileReader does, and no_such() where there is no such tile.
  template <class NoSuch>
  [[nodiscard]] const std::vector<store::SourceNumber>& numbers_of(std::uint64_t page, std::uint32_t tile,
                                                                   const NoSuch& no_such) {
    const TriangleId id = store::stored_id(page, tile, 0);
    const auto known = numbers.find(id);
    if (known != numbers.end()) return known->second;
    auto in = pages.find(page);
    if (in == pages.end()) {
      store::LoadedPage loaded = reader.page(page);
      make_room(store.pages[page].ref.bytes);
      in = pages.emplace(page, std::move(loaded)).first;
    }
    if (tile >= in->second.view.tiles.size()) throw no_such();
    auto read = reader.numbers(page, in->second.view.tiles[tile], tile);
    make_room(read.size() * sizeof(store::SourceNumber));
    return numbers.emplace(id, std::move(read)).first->second;
  }
  /// The name of the object of a triangle of a part. Throws roam::Error for a part file that is damaged.
  [[nodiscard]] std::string object(std::uint32_t part, std::uint64_t triangle);

 private:
  /// An object whose part has more of them than are kept.
  struct Object {
    std::uint32_t part;
    std::uint64_t first, end;  ///< of its triangles
    std::string name;
  };

  void make_room(std::size_t bytes) {
    if (used + bytes > most) {
      pages.clear();
      numbers.clear();
      parts.clear();
      objects.clear();
      used = 0;
    }
    used += bytes;
  }

  const State& store;
  store::TileReader reader;
  std::size_t used = 0;  ///< bytes
  std::map<std::uint64_t, store::LoadedPage> pages;
  std::map<TriangleId, std::vector<store::SourceNumber>> numbers;  ///< of a tile, by the id of its first triangle
  std::map<std::uint32_t, store::PartFile> parts;
  std::vector<Object> objects;
};

}  // namespace roam
