#include "index/partition.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "index/grid.h"
#include "math/largest.h"

namespace roam::index {
namespace {

constexpr int kCurveBits = 20;  // a coordinate along the curve: a cell of 1/2^20 of the scene's widest side
constexpr int kClassShift = 3 * kCurveBits;

/// Inserts two zero bits after each of the low 20 bits.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffffULL;
  x = (x | x << 16) & 0x001f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  return (x | x << 2) & 0x1249249249249249ULL;
}

/// 0 for ordinary triangles; each class above holds sixteen times wider ones.
std::uint64_t size_class(double extent) {
  std::uint64_t c = 0;
  for (double limit = kOrdinaryTriangle; extent > limit && c < 15; limit = std::ldexp(limit, kClassFactorBits)) ++c;
  return c;
}

struct Item {
  std::uint64_t key;  // size class, then place along the curve
  std::uint32_t triangle;
  bool operator<(const Item& o) const { return key != o.key ? key < o.key : triangle < o.triangle; }
};

Box box_of(const Triangle& t) {
  Box b;
  for (const Vec3& v : t) b.include(v);
  return b;
}

class Cutter {
 public:
  Cutter(const std::vector<Item>& items, const std::vector<float>& reach, double cell, double widest,
         std::vector<Partition::Run>& out)
      : items_(items), reach_(reach), cell_(cell), widest_(widest), out_(out) {}

  /// Cuts items[begin, end), which agree in all key bits above `bit`.
  void cut(std::uint32_t begin, std::uint32_t end, int bit) {
    const std::uint64_t c = items_[begin].key >> kClassShift;
    const std::uint32_t count = end - begin;
    if (count <= kTileTriangles && width(begin, end) <= limit(count <= kSparseTriangles ? c + 1 : c)) {
      out_.push_back({begin, end});
      return;
    }
    for (; bit >= 0; --bit) {
      const std::uint64_t mask = std::uint64_t{1} << bit;
      const auto middle =
          static_cast<std::uint32_t>(std::partition_point(items_.begin() + begin, items_.begin() + end,
                                                          [&](const Item& i) { return (i.key & mask) == 0; }) -
                                     items_.begin());
      if (middle == begin || middle == end) continue;
      cut(begin, middle, bit - 1);
      cut(middle, end, bit - 1);
      return;
    }
    // More triangles than a tile holds in one cell of the curve.
    for (; end - begin > kTileTriangles; begin += kTileTriangles) {
      out_.push_back({begin, begin + kTileTriangles});
    }
    out_.push_back({begin, end});
  }

 private:
  /// The widest side that a tile of the class may have.
  [[nodiscard]] double limit(std::uint64_t c) const {
    return std::min(widest_,
                    std::ldexp(kOrdinaryStep * double(kGridSteps - 4), kClassFactorBits * static_cast<int>(c)));
  }

  /// An upper bound of the widest side of the box of a run.
  [[nodiscard]] double width(std::uint32_t begin, std::uint32_t end) const {
    std::uint64_t lower[3], upper[3];
    for (int k = 0; k < 3; ++k) {
      lower[k] = ~std::uint64_t{0};
      upper[k] = 0;
    }
    float reach = 0.0F;
    constexpr std::uint64_t axis = 0x1249249249249249ULL;
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint64_t key = items_[i].key & ((std::uint64_t{1} << kClassShift) - 1);
      for (int k = 0; k < 3; ++k) {
        // Interleaved bits of one axis compare as the coordinate does.
        const std::uint64_t place = key >> k & axis;
        lower[k] = std::min(lower[k], place);
        upper[k] = std::max(upper[k], place);
      }
      reach = std::max(reach, reach_[items_[i].triangle]);
    }
    double widest = 0.0;
    for (int k = 0; k < 3; ++k) widest = std::max(widest, double(gather(upper[k]) - gather(lower[k]) + 1) * cell_);
    return widest + 2.0 * double(reach);
  }

  /// The inverse of spread.
  static std::uint64_t gather(std::uint64_t x) {
    x = (x | x >> 2) & 0x10c30c30c30c30c3ULL;
    x = (x | x >> 4) & 0x100f00f00f00f00fULL;
    x = (x | x >> 8) & 0x001f0000ff0000ffULL;
    x = (x | x >> 16) & 0x001f00000000ffffULL;
    return (x | x >> 32) & 0x00000000001fffffULL;
  }

  const std::vector<Item>& items_;
  const std::vector<float>& reach_;
  double cell_, widest_;
  std::vector<Partition::Run>& out_;
};

}  // namespace

Partition partition(const Soup& soup, bool lossless, const std::function<void(double)>& tick) {
  Partition result;
  const std::uint32_t count = soup.size();
  if (count == 0) return result;
  // Half the widest side of each triangle's box, rounded up: how far it may stick out of the cells of its run.
  std::vector<float> reach(count);
  std::vector<Item> items(count);
  const double side = std::max(largest(soup.bounds().size()), kOrdinaryTriangle);
  const double cell = side / double(1 << kCurveBits);
  for (std::size_t m = 0; m < soup.meshes().size(); ++m) {
    const Mesh& mesh = soup.meshes()[m];
    const auto first = static_cast<std::uint32_t>(soup.first()[m]);
    tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t i) {
      const Box box = box_of(mesh.triangle(i));
      const double extent = largest(box.size());
      const Vec3 place = (box.center() - soup.bounds().lower) / cell;
      std::uint64_t key = size_class(extent) << kClassShift;
      for (int k = 0; k < 3; ++k) {
        const auto c = static_cast<std::uint64_t>(std::clamp(place[k], 0.0, double((1 << kCurveBits) - 1)));
        key |= spread(c) << k;
      }
      const auto number = first + static_cast<std::uint32_t>(i);
      items[number] = {key, number};
      reach[number] = std::nextafter(static_cast<float>(0.5 * extent), std::numeric_limits<float>::infinity());
    });
  }
  tick(0.4);
  tbb::parallel_sort(items.begin(), items.end());
  tick(0.8);
  Cutter cutter(items, reach, cell, lossless ? kWidestLossless : kWidest, result.tiles);
  for (std::uint32_t begin = 0; begin < count;) {
    const std::uint64_t c = items[begin].key >> kClassShift;
    const auto end =
        static_cast<std::uint32_t>(std::partition_point(items.begin() + begin, items.end(),
                                                        [&](const Item& i) { return i.key >> kClassShift == c; }) -
                                   items.begin());
    cutter.cut(begin, end, kClassShift - 1);
    begin = end;
  }
  result.order.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) result.order[i] = items[i].triangle;
  tick(1.0);
  return result;
}

}  // namespace roam::index
