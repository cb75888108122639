#pragma once
/// \file
/// Division of a sorted run of triangles into tiles at the cells of a Morton curve.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "index/grid.h"
#include "index/partition.h"

namespace roam::index {

/// `Curve`: see curve.h. Items have a `key` and are sorted by it. `reach(item)` is half the widest side of a triangle's
/// box in metres, rounded up: the triangle may extend that far beyond the cells of its run.
///
/// A run with more than Curve::most_tile_triangles is always divided at the first key bit that differs. So cutting the
/// cells of such a division one by one gives the same tiles as cutting the whole.
template <class Curve, class Item, class Reach>
class Cutter {
 public:
  /// `cell`: side of the curve's smallest cell, m.
  Cutter(std::span<const Item> items, Reach reach, double cell, bool lossless)
      : items_(items), reach_(reach), cell_(cell), widest_(lossless ? widest_lossless : widest_box) {}

  /// Calls out(begin, end) for each tile of items[begin, end), which must be of one size class and not empty.
  template <class Out>
  void cut(std::uint32_t begin, std::uint32_t end, Out&& out) const {
    cut(begin, end, Curve::class_shift - 1, out);
  }

  /// Position where the cutter would divide items[begin, end): at the first bit that differs, or else in the middle.
  [[nodiscard]] std::uint32_t middle(std::uint32_t begin, std::uint32_t end) const {
    int bit = Curve::class_shift - 1;
    const std::uint32_t at = divide(begin, end, bit);
    return at == end ? begin + (end - begin) / 2 : at;
  }

 private:
  using Key = typename Curve::Key;

  /// items[begin, end) agree in all key bits above `bit`.
  template <class Out>
  void cut(std::uint32_t begin, std::uint32_t end, int bit, Out& out) const {
    const auto c = static_cast<int>(items_[begin].key >> Curve::class_shift);
    const std::uint32_t count = end - begin;
    if (count <= Curve::most_tile_triangles && width(begin, end) <= limit(count <= sparse_triangles ? c + 1 : c)) {
      out(begin, end);
      return;
    }
    const std::uint32_t at = divide(begin, end, bit);
    if (at != end) {
      cut(begin, at, bit - 1, out);
      cut(at, end, bit - 1, out);
      return;
    }
    // One cell of the curve holds more triangles than a tile may.
    for (; end - begin > Curve::most_tile_triangles; begin += Curve::most_tile_triangles)
      out(begin, begin + Curve::most_tile_triangles);
    out(begin, end);
  }

  /// Finds the highest bit, from `bit` down, in which the keys differ. Returns the first item with a one there, or
  /// `end` if all keys agree.
  std::uint32_t divide(std::uint32_t begin, std::uint32_t end, int& bit) const {
    const Key differ = items_[begin].key ^ items_[end - 1].key;
    for (; bit >= 0; --bit) {
      const Key mask = Key{1} << bit;
      if ((differ & mask) == 0) continue;
      return static_cast<std::uint32_t>(std::partition_point(items_.begin() + begin, items_.begin() + end,
                                                             [&](const Item& i) { return (i.key & mask) == 0; }) -
                                        items_.begin());
    }
    return end;
  }

  /// Metres. Upper limit of the widest side of a tile of the class.
  [[nodiscard]] double limit(int c) const {
    return std::min(widest_, std::ldexp(ordinary_step * double(grid_steps - 4), class_factor_bits * c));
  }

  /// Metres. Upper bound of the widest side of the box of a run.
  [[nodiscard]] double width(std::uint32_t begin, std::uint32_t end) const {
    Key lower[3], upper[3];
    for (int k = 0; k < 3; ++k) {
      lower[k] = ~Key{0};
      upper[k] = 0;
    }
    float reach = 0.0F;
    for (std::uint32_t i = begin; i < end; ++i) {
      const Key key = items_[i].key & ((Key{1} << Curve::class_shift) - 1);
      for (int k = 0; k < 3; ++k) {
        // Interleaved bits of one axis compare like the coordinate.
        const Key place = key >> k & Curve::axis_mask;
        lower[k] = std::min(lower[k], place);
        upper[k] = std::max(upper[k], place);
      }
      reach = std::max(reach, reach_(items_[i]));
    }
    double widest = 0.0;
    for (int k = 0; k < 3; ++k) {
      widest = std::max(widest, double(Curve::gather(upper[k]) - Curve::gather(lower[k]) + 1) * cell_);
    }
    return widest + 2.0 * double(reach);
  }

  std::span<const Item> items_;
  Reach reach_;
  double cell_, widest_;
};

}  // namespace roam::index
