#include "store/pager/units.h"

#include <algorithm>
#include <limits>

namespace roam::paging {

Units::Units(std::uint32_t count) : slots_(count), free_(count) { static_assert(sizeof(Slot) == unit_cost); }

Run Units::find(std::uint32_t count) const {
  std::uint32_t run = 0;
  for (std::uint32_t i = 0; i < slots_.size(); ++i) {
    run = slots_[i].free ? run + 1 : 0;
    if (run == count) return {i + 1 - count, count};
  }
  return {};
}

Run Units::cheapest(std::uint32_t count, double& worth) const {
  Run best;
  worth = std::numeric_limits<double>::infinity();
  if (count > slots_.size()) return best;
  // A best run begins at the first unit of an item, or at a unit without an item, so only these are tried.
  for (std::uint32_t begin = 0; begin + count <= slots_.size(); ++begin) {
    const bool boundary = slots_[begin].item.page == PagedItem::none || slots_[begin].first == begin;
    if (!boundary) continue;
    double most = 0.0;
    for (std::uint32_t i = begin; i < begin + count && most < worth;) {
      const Slot& slot = slots_[i];
      if (slot.item.page != PagedItem::none) {
        most = std::max(most, double(slots_[slot.first].worth));
        i = slot.first + slot.count;
      } else {
        if (!slot.free) most = std::numeric_limits<double>::infinity();
        ++i;
      }
    }
    if (most < worth) {
      worth = most;
      best = {begin, count};
    }
  }
  return best;
}

void Units::reserve(const Run& run) {
  for (std::uint32_t i = run.unit; i < run.unit + run.count; ++i) {
    if (slots_[i].free) --free_;
    slots_[i] = {};
    slots_[i].free = false;
  }
}

void Units::give(const Run& run, const PagedItem& item) {
  reserve(run);
  for (std::uint32_t i = run.unit; i < run.unit + run.count; ++i) {
    slots_[i].item = item;
    slots_[i].first = run.unit;
    slots_[i].count = run.count;
  }
}

void Units::release(const Run& run) {
  for (std::uint32_t i = run.unit; i < run.unit + run.count; ++i) {
    if (!slots_[i].free) ++free_;
    slots_[i] = {};
  }
}

}  // namespace roam::paging
