#pragma once
/// \file
/// The pages and tiles in memory, as queries see them. One thread changes them, only between queries.

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

/// Bytes of a unit. Each item in memory takes whole units.
inline constexpr std::size_t unit_bytes = 8192;

/// Marks the number of an unknown item. The number also has the page and tile of a TriangleId and, in place of the
/// triangle, the side of a cell or of a page's box.
inline constexpr TriangleId unknown_bit = TriangleId{1} << 63;
inline constexpr TriangleId page_sides = 0x3000;
[[nodiscard]] TriangleId unknown_base(const PagedItem& item);
/// The item of a number with unknown_bit.
[[nodiscard]] PagedItem unknown_thing(TriangleId number);

/// A page in memory: its view, and its tiles.
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
  /// Marks an item as failed. It is solid, and a body need not wait for it.
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

  /// Bytes that one page of a store needs here.
  static constexpr std::size_t page_cost = sizeof(Page) + 2 * 80 + 8;

 private:
  const std::byte* arena_;
  std::vector<Page> pages_;
  BoxTree tree_;
};

}  // namespace roam::paging
