#include "store/opened.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "math/boxes.h"

namespace roam::store {
namespace {

/// Whether the tile reaches no farther beyond the bounds of the scene's triangles than its own error.
bool within(const Box& bounds, const TileEntry& tile) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double error = double(tile.error);
  for (int k = 0; k < 3; ++k) {
    if (tile.lower[k] < std::nextafter(bounds.lower[k] - error, -infinity)) return false;
    if (tile.upper[k] > std::nextafter(bounds.upper[k] + error, infinity)) return false;
  }
  return meet(bounds, box_of(tile));
}

bool is_over_another(const PageView& view) {
  std::array<const TileEntry*, page_tiles> tiles;
  for (std::size_t i = 0; i < view.tiles.size(); ++i) tiles[i] = &view.tiles[i];
  const auto end = tiles.begin() + static_cast<std::ptrdiff_t>(view.tiles.size());
  std::sort(tiles.begin(), end, [](const TileEntry* a, const TileEntry* b) { return a->offset < b->offset; });
  return std::adjacent_find(tiles.begin(), end, [](const TileEntry* a, const TileEntry* b) {
           return b->offset - a->offset < std::uint64_t{a->bytes} + a->number_bytes;
         }) != end;
}

}  // namespace

const char* view_page_of(const Store::State& s, std::uint64_t number, std::span<const std::byte> bytes,
                         PageView& view) {
  const PageRef& ref = s.pages[number].ref;
  const ShardInfo& shard = s.manifest.shards[s.pages[number].shard];
  if (const char* problem = view_page(bytes, shard.bytes, view)) return problem;
  if (view.tiles.size() != ref.tiles) return "it has more or fewer tiles than said";
  Box all;
  for (const TileEntry& tile : view.tiles) {
    all.include(box_of(tile));
    if (std::all_of(std::begin(tile.mask), std::end(tile.mask), [](std::uint64_t layer) { return layer == 0; })) {
      return "a tile of it is nowhere in its box";
    }
    if (!within(s.manifest.bounds, tile)) return "a tile lies beyond the bounds of the scene";
    if (!(double(tile.fine_error) <= shard.largest_error)) return "a tile has a larger error than said";
  }
  if (all.lower != ref.box.lower || all.upper != ref.box.upper) {
    return "its box in the manifest is not that of its tiles";
  }
  return is_over_another(view) ? "tiles of it lie over each other in their pack" : nullptr;
}

}  // namespace roam::store
