#include "store/mask.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "index/grid.h"
#include "math/largest.h"

namespace roam::store {
namespace {

/// The axes that may separate a triangle from a box of half size h, except the box's own (Akenine-Möller, "Fast 3D
/// triangle-box overlap testing", 2001).
class Separation {
 public:
  Separation(const Triangle& t, const Vec3& h) {
    const Vec3 edge[3] = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
    add(glm::cross(edge[0], edge[1]), t, h);
    for (const Vec3& e : edge) {
      add({0.0, -e.z, e.y}, t, h);
      add({e.z, 0.0, -e.x}, t, h);
      add({-e.y, e.x, 0.0}, t, h);
    }
  }

  /// Whether the box around `centre` may touch the triangle.
  [[nodiscard]] bool touches(const Vec3& centre) const {
    for (const Axis& axis : axes_) {
      const double at = glm::dot(axis.direction, centre);
      if (at < axis.lower || at > axis.upper) return false;
    }
    return true;
  }

 private:
  struct Axis {
    Vec3 direction;
    double lower, upper;  ///< range along it of the centres of touching boxes
  };

  void add(const Vec3& d, const Triangle& t, const Vec3& h) {
    const double reach = std::abs(d.x) * h.x + std::abs(d.y) * h.y + std::abs(d.z) * h.z;
    const double a = glm::dot(d, t[0]), b = glm::dot(d, t[1]), c = glm::dot(d, t[2]);
    axes_[count_++] = {d, std::min({a, b, c}) - reach, std::max({a, b, c}) + reach};
  }

  std::array<Axis, 10> axes_;
  std::size_t count_ = 0;
};

/// Metres. The computations of a grid round by less than a thousandth of it.
double rounding(const Box& box) {
  return 0x1p-30 * largest(box.size()) + 0x1p-50 * std::max(largest(box.lower), largest(box.upper));
}

Box box_of(const Triangle& t) { return {glm::min(glm::min(t[0], t[1]), t[2]), glm::max(glm::max(t[0], t[1]), t[2])}; }

/// The least and the greatest number. As signed ones, of which the oldest processors compare eight at once.
std::pair<int, int> ends(const std::uint16_t (&numbers)[index::node_width]) {
  constexpr int half = 0x8000;
  std::int16_t least = INT16_MAX, most = INT16_MIN;
  for (const std::uint16_t number : numbers) {
    const auto shifted = static_cast<std::int16_t>(number ^ half);
    least = std::min(least, shifted);
    most = std::max(most, shifted);
  }
  return {least + half, most + half};
}

bool holds(const Box& box, const Vec3& lower, const Vec3& upper) {
  for (int k = 0; k < 3; ++k) {
    if (!(lower[k] >= box.lower[k] && upper[k] <= box.upper[k])) return false;
  }
  return true;
}

/// Whether the step is at most that of index::Grid::fitting. A larger one would have low bits of metres.
bool step_fits(const TileEntry& entry) {
  constexpr float finest = 0x1p-19F;
  static_assert(index::finest_exponent == -19);
  return entry.step <= finest ||
         0.5 * double(entry.step) * double(index::grid_steps - 2) < largest(box_of(entry).size());
}

/// Whether the low bits move no vertex farther than the errors say. Boxes of nodes and leaves enclose the vertices
/// without them.
bool low_bits_are_within(const TileView& tile) {
  // Both are distances from the source vertex; their roundings are smaller than 2^-10 of them.
  const double most = (double(tile.tile.error) + double(tile.tile.fine_error)) * (1.0 + 0x1p-10);
  const double low_step = double(tile.tile.step) / double(index::fine_steps);
  for (const index::FineLeaf& leaf : tile.fine) {
    for (int v = 0; v < index::node_width; ++v) {
      const Vec3 low(leaf.vertex[0][v], leaf.vertex[1][v], leaf.vertex[2][v]);
      if (glm::length(low_step * low) > most) return false;
    }
  }
  return true;
}

}  // namespace

Filled filled(const TileEntry& entry, const CellRange& range) {
  static_assert(mask_cells * mask_cells == 64, "a layer of cells is one word");
  const std::uint64_t row = (2ULL << range.last[0]) - (1ULL << range.first[0]);
  std::uint64_t layer = 0;
  for (int y = range.first[1]; y <= range.last[1]; ++y) layer |= row << (mask_cells * y);
  bool any = false, every = true;
  for (int z = range.first[2]; z <= range.last[2]; ++z) {
    any = any || (entry.mask[z] & layer) != 0;
    every = every && (entry.mask[z] & layer) == layer;
  }
  return every ? Filled::all : any ? Filled::some : Filled::none;
}

CellGrid::CellGrid(const Box& box, double margin) : lower_(box.lower), margin_(margin) {
  const Vec3 size = box.size();
  cell_ = size / double(mask_cells);
  half_ = 0.5 * cell_ + margin_;
  for (int k = 0; k < 3; ++k) per_metre_[k] = size[k] > 0.0 ? double(mask_cells) / size[k] : 0.0;
}

CellRange CellGrid::range(const Vec3& lower, const Vec3& upper) const {
  CellRange range;
  for (int k = 0; k < 3; ++k) {
    const auto cell = [&](double at) {
      const double cells = at * per_metre_[k];  // NaN in a box that is almost flat
      return cells > 0.0 ? static_cast<int>(std::min(cells, double(mask_cells - 1))) : 0;
    };
    range.first[k] = cell(lower[k] - lower_[k] - margin_);
    range.last[k] = cell(upper[k] - lower_[k] + margin_);
  }
  return range;
}

template <class F>
bool CellGrid::visit(const Triangle& triangle, F&& f) const {
  const Box extent = box_of(triangle);
  const CellRange r = range(extent.lower, extent.upper);
  int cells = 1;
  for (int k = 0; k < 3; ++k) cells *= r.last[k] - r.first[k] + 1;
  if (cells == 1) return f(r.first[0], r.first[1], r.first[2]);
  const Separation separation({triangle[0] - lower_, triangle[1] - lower_, triangle[2] - lower_}, half_);
  for (int z = r.first[2]; z <= r.last[2]; ++z) {
    for (int y = r.first[1]; y <= r.last[1]; ++y) {
      for (int x = r.first[0]; x <= r.last[0]; ++x) {
        const Vec3 centre = cell_ * Vec3(x + 0.5, y + 0.5, z + 0.5);
        if ((cells == 2 || separation.touches(centre)) && !f(x, y, z)) return false;
      }
    }
  }
  return true;
}

Mask::Mask(const Box& box, double margin) : grid_(box, margin + rounding(box)) {}

void Mask::add(const Triangle& triangle) {
  grid_.visit(triangle, [&](int x, int y, int z) {
    const int bit = x + mask_cells * (y + mask_cells * z);
    words[static_cast<std::size_t>(bit / 64)] |= std::uint64_t{1} << (bit % 64);
    return true;
  });
}

const char* check_place(const TileEntry& entry, const TileView& tile) {
  if (!low_bits_are_within(tile)) return "its errors are smaller than its low bits";
  const Box box = box_of(entry);
  // Without a margin: a builder's mask, which has one, is never refused for rounding.
  const CellGrid grid(box, 0.0);
  const double low = tile.fine.empty() ? 0.0 : 0.5;  // of a step: the reach of the low bits
  for (std::size_t l = 0; l < tile.leaves.size(); ++l) {
    const index::Leaf& leaf = tile.leaves[l];
    // A leaf whose whole box is good needs no look at its triangles.
    Vec3 lower, upper;
    for (int k = 0; k < 3; ++k) {
      const auto [least, most] = ends(leaf.vertex[k]);
      lower[k] = tile.tile.origin[k] + double(tile.tile.step) * (least - low);
      upper[k] = tile.tile.origin[k] + double(tile.tile.step) * (most + low);
    }
    if (holds(box, lower, upper) && filled(entry, grid.range(lower, upper)) == Filled::all) continue;
    for (int i = 0; i < leaf.triangle_count; ++i) {
      const Triangle triangle = stored_triangle(tile.tile, leaf, tile.fine.empty() ? nullptr : &tile.fine[l], i);
      const Box extent = box_of(triangle);
      if (!holds(box, extent.lower, extent.upper)) return "a triangle lies outside its box";
      if (filled(entry, grid.range(extent.lower, extent.upper)) == Filled::all) continue;
      if (!grid.visit(triangle, [&](int x, int y, int z) {
            return filled(entry, {{x, y, z}, {x, y, z}}) == Filled::all;
          })) {
        return "a triangle lies outside its mask";
      }
    }
  }
  if (!tile.fine.empty() && !step_fits(entry)) return "its step is larger than its box needs";
  return nullptr;
}

}  // namespace roam::store
