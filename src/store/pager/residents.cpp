#include "store/pager/residents.h"

#include "store/tile_reader.h"

namespace roam::paging {
namespace {

/// Of an absent tile, in place of where its leaves are.
constexpr std::uint32_t tile_failed = 1;

constexpr std::uint32_t unit_blocks = unit_bytes / sizeof(index::Block);

}  // namespace

TriangleId unknown_base(const Thing& thing) {
  const TriangleId tile = thing.is_page() ? 0 : thing.tile;
  return unknown_bit | store::stored_id(thing.page, static_cast<std::uint32_t>(tile), 0) |
         (thing.is_page() ? page_sides : 0);
}

Thing unknown_thing(TriangleId number) {
  const TriangleId id = number & ~unknown_bit;
  Thing thing;
  thing.page = static_cast<std::uint32_t>(id >> (store::triangle_bits + store::tile_bits));
  const bool whole = (id & page_sides) == page_sides;
  if (!whole) thing.tile = static_cast<std::uint32_t>(id >> store::triangle_bits & (store::page_tiles - 1));
  return thing;
}

Residents::Residents(const Store::State& store, const std::byte* arena) : arena_(arena) {
  std::vector<BoxTree::Item> items;
  pages_.reserve(store.pages.size());
  items.reserve(store.pages.size());
  for (const Store::State::Page& page : store.pages) {
    items.push_back({page.ref.box, static_cast<std::uint32_t>(pages_.size())});
    pages_.push_back({page.ref.box, {}, false});
  }
  tree_.change(items, {});
}

void Residents::put_page(std::uint32_t page, const PageInMemory& in) {
  pages_[page].in = in;
  pages_[page].failed = false;
}

void Residents::put_tile(const Thing& thing, std::uint32_t unit) {
  const PageInMemory& in = pages_[thing.page].in;
  const store::TileEntry& entry = in.view.tiles[thing.tile];
  index::Tile& tile = in.tiles[thing.tile];
  tile.nodes = unit * unit_blocks;
  tile.leaves = tile.nodes + entry.nodes;
  tile.fine_leaves = (std::uint64_t{tile.leaves} + entry.leaves) * sizeof(index::Block);
}

void Residents::take(const Thing& thing) {
  if (thing.is_page()) {
    pages_[thing.page].in = {};
  } else {
    index::Tile& tile = pages_[thing.page].in.tiles[thing.tile];
    tile.nodes = index::Tile::kAbsent;
    tile.leaves = 0;
  }
}

void Residents::fail(const Thing& thing) {
  if (thing.is_page()) {
    pages_[thing.page].failed = true;
  } else {
    pages_[thing.page].in.tiles[thing.tile].leaves = tile_failed;
  }
}

Box Residents::box(const Thing& thing) const {
  const Page& page = pages_[thing.page];
  return thing.is_page() ? page.box : box_of(page.in.view.tiles[thing.tile]);
}

index::Index Residents::view(const Page& page, const index::Absent& absent) const {
  return {.top = reinterpret_cast<const index::Block*>(page.in.view.nodes.data()),
          .tiles = page.in.tiles,
          .blocks = reinterpret_cast<const index::Block*>(arena_),
          .fine = arena_,
          .ids = nullptr,
          .grid = page.in.view.grid,
          .absent = &absent};
}

bool Residents::has_failed(const Thing& thing) const {
  const Page& page = pages_[thing.page];
  return thing.is_page() ? page.failed : page.in.tiles[thing.tile].leaves == tile_failed;
}

}  // namespace roam::paging
