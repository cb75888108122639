#include "index/partition.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "index/curve.h"
#include "index/cutter.h"
#include "math/boxes.h"
#include "math/largest.h"

namespace roam::index {
namespace {

using Curve = SceneCurve;

struct Item {
  std::uint64_t key;  // size class, then position along the curve
  std::uint32_t triangle;
  bool operator<(const Item& o) const { return key != o.key ? key < o.key : triangle < o.triangle; }
};

}  // namespace

Partition partition(const Soup& soup, bool lossless, const std::function<void(double)>& tick) {
  Partition result;
  const std::uint32_t count = soup.size();
  if (count == 0) return result;
  // Metres. Half the widest side of each triangle's box, rounded up: the triangle may extend that far beyond its run's
  // cells.
  std::vector<float> reach(count);
  std::vector<Item> items(count);
  const double side = std::max(largest(soup.bounds().size()), ordinary_triangle);
  const double cell = side / double(1 << Curve::axis_bits);
  for (std::size_t m = 0; m < soup.meshes().size(); ++m) {
    const Mesh& mesh = soup.meshes()[m];
    const auto first = static_cast<std::uint32_t>(soup.first()[m]);
    tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t i) {
      const Box box = box_around(mesh.triangle(i));
      const double extent = largest(box.size());
      const Vec3 place = (box.center() - soup.bounds().lower) / cell;
      std::uint64_t key = std::uint64_t{size_class(extent)} << Curve::class_shift;
      for (int k = 0; k < 3; ++k) {
        const auto c = static_cast<std::uint64_t>(std::clamp(place[k], 0.0, double((1 << Curve::axis_bits) - 1)));
        key |= Curve::spread(c) << k;
      }
      const auto number = first + static_cast<std::uint32_t>(i);
      items[number] = {key, number};
      reach[number] = std::nextafter(static_cast<float>(0.5 * extent), std::numeric_limits<float>::infinity());
    });
  }
  tick(0.4);
  tbb::parallel_sort(items.begin(), items.end());
  tick(0.8);
  const auto reach_of = [&](const Item& item) { return reach[item.triangle]; };
  const Cutter<Curve, Item, decltype(reach_of)> cutter(items, reach_of, cell, lossless);
  for (std::uint32_t begin = 0; begin < count;) {
    const std::uint64_t c = items[begin].key >> Curve::class_shift;
    const auto end = static_cast<std::uint32_t>(
        std::partition_point(items.begin() + begin, items.end(),
                             [&](const Item& i) { return i.key >> Curve::class_shift == c; }) -
        items.begin());
    cutter.cut(begin, end, [&](std::uint32_t first, std::uint32_t last) { result.tiles.push_back({first, last}); });
    begin = end;
  }
  result.order.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) result.order[i] = items[i].triangle;
  tick(1.0);
  return result;
}

}  // namespace roam::index
