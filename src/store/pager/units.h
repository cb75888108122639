#pragma once
/// \file
/// Allocation of the arena's units to items.

#include <cstdint>
#include <vector>

#include "store/pager/paged_item.h"
#include "store/pager/tracked_body.h"

namespace roam::paging {

/// A run of consecutive units.
struct Run {
  static constexpr std::uint32_t none = UINT32_MAX;
  std::uint32_t unit = none;
  std::uint32_t count = 0;
  [[nodiscard]] bool found() const { return unit != none; }
};

class Units {
 public:
  explicit Units(std::uint32_t count);
  static constexpr std::size_t unit_cost = 24;

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(slots_.size()); }
  [[nodiscard]] std::uint32_t free() const { return free_; }
  /// The first run of `count` free units.
  [[nodiscard]] Run find(std::uint32_t count) const;
  /// The run of `count` units with the least worth. The worth of a run is the largest worth in it. Free units have
  /// worth 0, and reserved units infinite worth.
  [[nodiscard]] Run cheapest(std::uint32_t count, double& worth) const;

  /// Reserves a run for a request, or gives it to an item. Units that were free are not free any more.
  void reserve(const Run& run);
  void give(const Run& run, const PagedItem& item);
  void release(const Run& run);

  /// Calls f(run, item) for every item with units in the run.
  template <class F>
  void for_each(const Run& run, F&& f) const {
    for (std::uint32_t i = run.unit; i < run.unit + run.count;) {
      const Slot& slot = slots_[i];
      if (slot.item.page == PagedItem::none) {
        ++i;
        continue;
      }
      f(Run{slot.first, slot.count}, slot.item);
      i = slot.first + slot.count;
    }
  }
  [[nodiscard]] bool is_free(std::uint32_t unit) const { return slots_[unit].free; }
  [[nodiscard]] bool is_reserved(std::uint32_t unit) const {
    return !slots_[unit].free && slots_[unit].item.page == PagedItem::none;
  }
  /// Sets the worth of an item by its first unit.
  void set_worth(std::uint32_t unit, double worth) { slots_[unit].worth = static_cast<float>(worth); }

 private:
  struct Slot {
    PagedItem item;
    std::uint32_t first = 0, count = 1;  ///< of the item's run
    float worth = 0.0F;                  ///< valid in the first unit of an item
    bool free = true;
  };
  std::vector<Slot> slots_;
  std::uint32_t free_;
};

}  // namespace roam::paging
