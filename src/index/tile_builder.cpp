#include "index/tile_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "index/collapse.h"
#include "index/grid.h"
#include "math/largest.h"
#include "math/mix.h"

namespace roam::index {
namespace {

/// Metres. Typical growth of a box's sides by a query: the body and its motion in one step.
constexpr double query_margin = 0.2;

/// A stored vertex: three coordinates in fine steps if its tile has low bits, else in whole steps.
struct VertexKey {
  std::uint64_t xy, z;
  bool operator==(const VertexKey&) const = default;
};

class TileBuilder {
 public:
  TileBuilder(std::span<const Triangle> triangles, std::span<const std::uint32_t> ids, bool lossless)
      : triangles_(triangles), ids_(ids) {
    for (const Triangle& t : triangles) {
      for (const Vec3& v : t) out_.bounds.include(v);
    }
    grid_ = Grid::fitting(out_.bounds);
    fine_ = lossless || grid_.step > ordinary_step;
  }

  BuiltTile run() {
    quantize();
    BinaryTreeOptions options;
    options.fits_leaf = [this](std::span<const std::uint32_t> items) { return fits_leaf(items); };
    options.vertices = vertices_;
    options.margin = std::max(1.0, query_margin / grid_.step);
    const BinaryTree tree = build_binary_tree(boxes_, options);
    WideTree wide = collapse(tree, options.margin);
    out_.nodes = std::move(wide.nodes);
    out_.leaves.reserve(wide.leaves.size());
    for (const std::uint32_t n : wide.leaves) {
      const BinaryNode& node = tree.nodes[n];
      add_leaf({tree.order.data() + node.begin, tree.order.data() + node.end});
    }
    return std::move(out_);
  }

 private:
  void quantize() {
    corners_.resize(triangles_.size());
    boxes_.resize(triangles_.size());
    vertices_.resize(triangles_.size());
    double worst = 0.0, worst_fine = 0.0;  // squared
    const double fine_step = grid_.step / double(fine_steps);
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        const Vec3& v = triangles_[i][c];
        const auto f = grid_.fine(v);
        std::array<std::int64_t, 3> whole;
        double error = 0.0, error_fine = 0.0;
        StepBox point;
        for (int k = 0; k < 3; ++k) {
          whole[k] = Grid::whole(f[k]);
          point.lower[k] = point.upper[k] = static_cast<std::int32_t>(whole[k]);
          const double at = v[k] - grid_.origin[k];
          const double e = at - grid_.step * double(whole[k]), ef = at - fine_step * double(f[k]);
          error += e * e;
          error_fine += ef * ef;
        }
        const auto& stored = fine_ ? f : whole;
        corners_[i][c] = {std::uint64_t(stored[0]) << 32 | std::uint64_t(stored[1]), std::uint64_t(stored[2])};
        vertices_[i][c] = static_cast<std::uint32_t>(mix(corners_[i][c].xy ^ mix(corners_[i][c].z)));
        boxes_[i].include(point);
        worst = std::max(worst, error);
        worst_fine = std::max(worst_fine, error_fine);
      }
    }
    const double farthest = std::max(largest(out_.bounds.lower), largest(out_.bounds.upper));
    // The subtraction of the origin rounds by at most 2^-53 of the coordinates, the rest by less than 2^-20 of itself.
    const auto round_up = [&](double squared) {
      const double e = std::sqrt(squared) * (1.0 + 0x1p-20) + 0x1p-51 * farthest;
      return std::nextafter(static_cast<float>(e), std::numeric_limits<float>::infinity());
    };
    out_.tile = {};
    out_.tile.origin = grid_.origin;
    out_.tile.step = static_cast<float>(grid_.step);
    out_.tile.fine = fine_;
    out_.tile.error = round_up(worst);
    out_.tile.fine_error = fine_ ? round_up(worst_fine) : out_.tile.error;
  }

  /// Collects the distinct vertices of the triangles in order of first use. False if there are more than a leaf holds.
  bool distinct(std::span<const std::uint32_t> items, std::array<VertexKey, node_width>& keys, int& count,
                Leaf* leaf) const {
    count = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        const VertexKey& v = corners_[items[i]][c];
        int found = 0;
        while (found < count && keys[found] != v) ++found;
        if (found == count) {
          if (count == node_width) return false;
          keys[count++] = v;
        }
        if (leaf) leaf->corner[c][i / 8] |= static_cast<std::uint32_t>(found) << (4 * (i % 8));
      }
    }
    return true;
  }

  [[nodiscard]] bool fits_leaf(std::span<const std::uint32_t> items) const {
    if (items.size() > node_width) return false;
    std::array<VertexKey, node_width> keys;
    int count = 0;
    return distinct(items, keys, count, nullptr);
  }

  void add_leaf(std::span<const std::uint32_t> unsorted) {
    // Sorted ids have small differences. The order of lanes then does not depend on how the tree was built.
    std::array<std::uint32_t, node_width> items{};
    std::copy(unsorted.begin(), unsorted.end(), items.begin());
    std::sort(items.begin(), items.begin() + unsorted.size());
    const std::span<const std::uint32_t> triangles(items.data(), unsorted.size());

    Leaf leaf{};
    leaf.triangle_count = static_cast<std::uint8_t>(triangles.size());
    std::array<VertexKey, node_width> keys;
    int count = 0;
    distinct(triangles, keys, count, &leaf);
    for (std::size_t i = triangles.size(); i < node_width; ++i) {
      for (auto& c : leaf.corner) c[i / 8] |= (c[0] & 15U) << (4 * (i % 8));
    }
    FineLeaf low{};
    for (int v = 0; v < node_width; ++v) {
      const VertexKey& k = keys[v < count ? v : 0];
      const std::array<std::int64_t, 3> p{std::int64_t(k.xy >> 32), std::int64_t(k.xy & 0xffffffffU),
                                          std::int64_t(k.z)};
      for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t whole = fine_ ? Grid::whole(p[axis]) : p[axis];
        leaf.vertex[axis][v] = static_cast<std::uint16_t>(whole);
        if (fine_) low.vertex[axis][v] = static_cast<std::int16_t>(p[axis] - whole * fine_steps);
      }
    }
    if (fine_) out_.fine_leaves.push_back(low);
    write_ids(leaf, triangles);
    out_.leaves.push_back(leaf);
  }

  void write_ids(Leaf& leaf, std::span<const std::uint32_t> triangles) {
    const std::uint32_t base = ids_[triangles.front()];
    const std::uint32_t widest = ids_[triangles.back()] - base;
    leaf.id_bytes = static_cast<std::uint8_t>(widest == 0         ? 0
                                              : widest < 1U << 8  ? 1
                                              : widest < 1U << 16 ? 2
                                              : widest < 1U << 24 ? 3
                                                                  : 4);
    leaf.ids = static_cast<std::uint32_t>(out_.ids.size());
    const auto put = [&](std::uint32_t value, int bytes) {
      for (int b = 0; b < bytes; ++b) out_.ids.push_back(static_cast<std::uint8_t>(value >> (8 * b)));
    };
    put(base, 4);
    for (const std::uint32_t t : triangles) put(ids_[t] - base, leaf.id_bytes);
  }

  std::span<const Triangle> triangles_;
  std::span<const std::uint32_t> ids_;
  bool fine_ = false;
  std::vector<std::array<VertexKey, 3>> corners_;
  std::vector<std::array<std::uint32_t, 3>> vertices_;  ///< hashes
  std::vector<StepBox> boxes_;
  Grid grid_;
  BuiltTile out_;
};

}  // namespace

BuiltTile build_tile(const Soup& soup, std::span<const std::uint32_t> ids, bool lossless) {
  std::vector<Triangle> triangles(ids.size());
  soup.for_each(ids, [&](std::size_t i, const Triangle& t) { triangles[i] = t; });
  return build_tile(triangles, ids, lossless);
}

BuiltTile build_tile(std::span<const Triangle> triangles, std::span<const std::uint32_t> ids, bool lossless) {
  return TileBuilder(triangles, ids, lossless).run();
}

std::uint32_t read_id(const std::uint8_t* tile_ids, const Leaf& leaf, int i) {
  const auto get = [](const std::uint8_t* at, int bytes) {
    std::uint32_t value = 0;
    for (int b = 0; b < bytes; ++b) value |= std::uint32_t{at[b]} << (8 * b);
    return value;
  };
  const std::uint8_t* base = tile_ids + leaf.ids;
  return get(base, 4) + get(base + 4 + i * leaf.id_bytes, leaf.id_bytes);
}

}  // namespace roam::index
