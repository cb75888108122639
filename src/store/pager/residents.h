#pragma once
/// \file
/// What queries see: which pages and tiles are in memory. Changed between queries only, by one thread.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "index/traverse.h"
#include "roam/pager.h"
#include "store/opened.h"
#include "store/page.h"
#include "store/pager/paged_item.h"
#include "store/pager/tracked_body.h"
#include "world/box_tree.h"

namespace roam::paging {

/// Bytes that items in memory take a multiple of.
inline constexpr std::size_t unit_bytes = 8192;

/// Numbers of what is unknown, which is no triangle: this bit, page and tile as in a TriangleId, and the side of the
/// cell, or of a page's box, where the triangle would be.
inline constexpr TriangleId unknown_bit = TriangleId{1} << 63;
inline constexpr TriangleId page_sides = 0x3000;
[[nodiscard]] TriangleId unknown_base(const PagedItem& item);
/// Of a number with unknown_bit.
[[nodiscard]] PagedItem unknown_thing(TriangleId number);

/// A page in memory: as it was read, and of each tile where it is.
struct PageInMemory {
  store::PageView view;
  index::Tile* tiles = nullptr;
};

class Residents {
 public:
  Residents(const Store::State& store, const std::byte* arena);

  // For update().
  void put_page(std::uint32_t page, const PageInMemory& in);
  void put_tile(const PagedItem& tile, std::uint32_t unit);
  void take(const PagedItem& item);
  /// It is solid because it failed: nobody need wait for it.
  void fail(const PagedItem& item);
  [[nodiscard]] bool has_page(std::uint32_t page) const { return pages_[page].in.tiles != nullptr; }
  [[nodiscard]] Box box(const PagedItem& item) const;

  // For queries.
  struct Page {
    Box box;
    PageInMemory in;
    bool failed = false;
  };
  [[nodiscard]] const Page& page(std::uint32_t number) const { return pages_[number]; }
  [[nodiscard]] const BoxTree& tree() const { return tree_; }
  [[nodiscard]] index::Index view(const Page& page, const index::Absent& absent) const;
  [[nodiscard]] bool has_failed(const PagedItem& item) const;

  /// Bytes that one page of a store costs here.
  static constexpr std::size_t page_cost = sizeof(Page) + 2 * 80 + 8;

 private:
  const std::byte* arena_;
  std::vector<Page> pages_;
  BoxTree tree_;
};

}  // namespace roam::paging
