#pragma once
/// \file
/// Who has which units of the arena.

#include <cstdint>
#include <vector>

#include "store/pager/paged_item.h"
#include "store/pager/tracked_body.h"

namespace roam::paging {

/// A run of units.
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
  /// The first run of so many free units.
  [[nodiscard]] Run find(std::uint32_t count) const;
  /// The run of so many units that is worth least: that is worth no more than any other. `worth` of a run is the
  /// largest of what is in it; free units are worth nothing, and what must stay more than any number.
  [[nodiscard]] Run cheapest(std::uint32_t count, double& worth) const;

  /// Gives a run to a request, which is `reserved` from then on; or to a item. Units that were free are so no more.
  void reserve(const Run& run);
  void give(const Run& run, const PagedItem& item);
  void release(const Run& run);

  /// Calls f(run, item) for every item that has units in the run.
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
  /// What a item is worth, by its first unit.
  void set_worth(std::uint32_t unit, double worth) { slots_[unit].worth = static_cast<float>(worth); }

 private:
  struct Slot {
    PagedItem item;
    std::uint32_t first = 0, count = 1;  ///< of the item
    float worth = 0.0F;                  ///< in the first unit of a item
    bool free = true;
  };
  std::vector<Slot> slots_;
  std::uint32_t free_;
};

}  // namespace roam::paging
