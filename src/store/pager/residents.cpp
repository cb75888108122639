#include "store/pager/residents.h"

#include "store/tile_reader.h"

namespace roam::paging {
namespace {

/// Marks an absent tile as failed, in the field for its leaves.
constexpr std::uint32_t tile_failed = 1;

constexpr std::uint32_t unit_blocks = unit_bytes / sizeof(index::Block);

}  // namespace

TriangleId unknown_base(const PagedItem& item) {
  const TriangleId tile = item.is_page() ? 0 : item.tile;
  return unknown_bit | store::stored_id(item.page, static_cast<std::uint32_t>(tile), 0) |
         (item.is_page() ? page_sides : 0);
}

PagedItem unknown_thing(TriangleId number) {
  const TriangleId id = number & ~unknown_bit;
  PagedItem item;
  item.page = static_cast<std::uint32_t>(id >> (store::triangle_bits + store::tile_bits));
  const bool whole = (id & page_sides) == page_sides;
  if (!whole) item.tile = static_cast<std::uint32_t>(id >> store::triangle_bits & (store::page_tiles - 1));
  return item;
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

void Residents::put_tile(const PagedItem& item, std::uint32_t unit) {
  const PageInMemory& in = pages_[item.page].in;
  const store::TileEntry& entry = in.view.tiles[item.tile];
  index::Tile& tile = in.tiles[item.tile];
  tile.nodes = unit * unit_blocks;
  tile.leaves = tile.nodes + entry.nodes;
  tile.fine_leaves = (std::uint64_t{tile.leaves} + entry.leaves) * sizeof(index::Block);
}

void Residents::take(const PagedItem& item) {
  if (item.is_page()) {
    pages_[item.page].in = {};
  } else {
    index::Tile& tile = pages_[item.page].in.tiles[item.tile];
    tile.nodes = index::Tile::absent_leaf;
    tile.leaves = 0;
  }
}

void Residents::fail(const PagedItem& item) {
  if (item.is_page()) {
    pages_[item.page].failed = true;
  } else {
    pages_[item.page].in.tiles[item.tile].leaves = tile_failed;
  }
}

Box Residents::box(const PagedItem& item) const {
  const Page& page = pages_[item.page];
  return item.is_page() ? page.box : box_of(page.in.view.tiles[item.tile]);
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

bool Residents::has_failed(const PagedItem& item) const {
  const Page& page = pages_[item.page];
  return item.is_page() ? page.failed : page.in.tiles[item.tile].leaves == tile_failed;
}

}  // namespace roam::paging
