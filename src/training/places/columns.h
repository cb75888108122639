#pragma once
/// \file
/// Places of components, found by position.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "math/random.h"
#include "roam/math.h"

namespace roam::training {

/// Places in columns, square cells of the plan.
class Columns {
 public:
  struct Entry {
    double z = 0.0;
    std::uint32_t owner = 0;
  };

  explicit Columns(double cell) : cell_(cell) {}

  void add(const Vec3& place, std::uint32_t owner) {
    if (2 * (used_ + 1) > table_.size()) grow();
    const std::uint64_t column = key(index(place.x), index(place.y));
    Slot& slot = table_[find(column)];
    if (slot.last == none) ++used_;
    kept_.push_back({{place.z, owner}, slot.last});
    slot = {column, static_cast<std::uint32_t>(kept_.size() - 1)};
  }
  /// Whether `accept` returns true for an entry in the column of `place` or up to `around` columns beside it. Newest
  /// entries first.
  template <class Accept>
  [[nodiscard]] bool any(const Vec3& place, int around, const Accept& accept) const {
    const std::int64_t x = index(place.x), y = index(place.y);
    for (std::int64_t i = x - around; i <= x + around; ++i) {
      for (std::int64_t j = y - around; j <= y + around; ++j) {
        for (std::uint32_t at = table_[find(key(i, j))].last; at != none; at = kept_[at].before)
          if (accept(kept_[at].entry)) return true;
      }
    }
    return false;
  }

 private:
  [[nodiscard]] std::int64_t index(double x) const { return static_cast<std::int64_t>(std::floor(x / cell_)); }
  /// Coordinates up to 1e9 m give distinct keys.
  [[nodiscard]] static std::uint64_t key(std::int64_t i, std::int64_t j) {
    return (static_cast<std::uint64_t>(i) << 32) ^ (static_cast<std::uint64_t>(j) & 0xFFFFFFFFULL);
  }
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  struct Kept {
    Entry entry;
    std::uint32_t before;  ///< the previous entry of the column; none
  };
  struct Slot {
    std::uint64_t column = 0;
    std::uint32_t last = none;  ///< index of its newest entry; none: the slot is free
  };

  /// The slot of a column, or the free one where it would be.
  [[nodiscard]] std::size_t find(std::uint64_t column) const {
    const std::size_t last = table_.size() - 1;  // a power of two less one
    std::size_t i = static_cast<std::size_t>(mix(column)) & last;
    while (table_[i].last != none && table_[i].column != column) i = (i + 1) & last;
    return i;
  }
  void grow() {
    std::vector<Slot> old(2 * table_.size());
    old.swap(table_);
    for (const Slot& slot : old)
      if (slot.last != none) table_[find(slot.column)] = slot;
  }

  double cell_;
  std::vector<Slot> table_ = std::vector<Slot>(1024);  ///< open addressing, at most half full
  std::size_t used_ = 0;
  std::vector<Kept> kept_;
};

}  // namespace roam::training
