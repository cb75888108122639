#pragma once
/// \file
/// Numbers of the items that a pager loads: tiles, and pages of the index.

#include <cstdint>

namespace roam::paging {

/// A tile of a page, or the page itself.
struct PagedItem {
  static constexpr std::uint32_t none = UINT32_MAX;
  static constexpr std::uint32_t whole = UINT32_MAX;

  std::uint32_t page = none;
  std::uint32_t tile = whole;

  [[nodiscard]] bool is_page() const { return tile == whole; }
  bool operator==(const PagedItem&) const = default;
};

}  // namespace roam::paging
