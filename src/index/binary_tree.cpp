#include "index/binary_tree.h"

#include <algorithm>
#include <array>
#include <limits>

namespace roam::index {
namespace {

constexpr int kBins = 16;
/// Up to this many items every split position is tried instead of bins.
constexpr std::uint32_t kExactBelow = 64;

struct Split {
  double cost = std::numeric_limits<double>::infinity();
  int axis = -1;
  std::int64_t position = 0;  ///< items whose doubled centre lies below it go left
};

class Builder {
 public:
  Builder(std::span<const StepBox> boxes, const BinaryTreeOptions& options) : boxes_(boxes), options_(options) {
    tree_.order.resize(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) tree_.order[i] = i;
    tree_.nodes.reserve(boxes.size() / 4 + 16);
  }

  BinaryTree run() {
    tree_.nodes.push_back(node(0, static_cast<std::uint32_t>(boxes_.size())));
    std::vector<std::pair<std::int32_t, int>> open{{0, 0}};
    while (!open.empty()) {
      const auto [index, depth] = open.back();
      open.pop_back();
      const BinaryNode n = tree_.nodes[index];
      if (options_.fits_leaf({tree_.order.data() + n.begin, n.end - n.begin})) continue;
      const std::uint32_t middle = divide(n, depth);
      const auto left = static_cast<std::int32_t>(tree_.nodes.size());
      tree_.nodes[index].left = left;
      tree_.nodes.push_back(node(n.begin, middle));
      tree_.nodes.push_back(node(middle, n.end));
      open.push_back({left + 1, depth + 1});
      open.push_back({left, depth + 1});
    }
    return std::move(tree_);
  }

 private:
  [[nodiscard]] std::int64_t centre(std::uint32_t item, int axis) const {  // doubled, so that it is whole
    return std::int64_t{boxes_[item].lower[axis]} + boxes_[item].upper[axis];
  }

  [[nodiscard]] double tests(std::uint32_t items) const {
    return double((items + options_.items_per_test - 1) / options_.items_per_test);
  }

  [[nodiscard]] BinaryNode node(std::uint32_t begin, std::uint32_t end) const {
    BinaryNode n;
    n.begin = begin;
    n.end = end;
    for (std::uint32_t i = begin; i < end; ++i) n.box.include(boxes_[tree_.order[i]]);
    return n;
  }

  /// Reorders the items of `n` in two halves and returns where the second begins.
  std::uint32_t divide(const BinaryNode& n, int depth) {
    const std::uint32_t count = n.end - n.begin;
    if (depth < kSahDepth) {
      if (count <= kExactBelow) return divide_exactly(n);
      const Split split = best_binned(n);
      if (split.axis >= 0) {
        const auto first = tree_.order.begin() + n.begin;
        const auto middle = std::partition(first, tree_.order.begin() + n.end, [&](std::uint32_t item) {
          return centre(item, split.axis) < split.position;
        });
        return n.begin + static_cast<std::uint32_t>(middle - first);
      }
    }
    return halve(n);
  }

  std::uint32_t halve(const BinaryNode& n) {
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
      if (n.box.upper[k] - n.box.lower[k] > n.box.upper[axis] - n.box.lower[axis]) axis = k;
    }
    const std::uint32_t middle = n.begin + (n.end - n.begin) / 2;
    std::nth_element(tree_.order.begin() + n.begin, tree_.order.begin() + middle, tree_.order.begin() + n.end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       return std::pair(centre(a, axis), a) < std::pair(centre(b, axis), b);
                     });
    return middle;
  }

  /// Tries each position between two centres on each axis.
  std::uint32_t divide_exactly(const BinaryNode& n) {
    const std::uint32_t count = n.end - n.begin;
    std::uint32_t* items = tree_.order.data() + n.begin;
    // By centre, then by item: one number sorts twice as fast as a pair.
    constexpr int item_bits = 24;
    constexpr std::uint64_t item_mask = (1U << item_bits) - 1;
    std::array<std::array<std::uint64_t, kExactBelow>, 3> sorted;
    std::array<double, kExactBelow> area_left{};
    double best_cost = std::numeric_limits<double>::infinity();
    int best_axis = 0;
    std::uint32_t best_position = count / 2;
    for (int axis = 0; axis < 3; ++axis) {
      auto& keys = sorted[axis];
      const std::int64_t first = 2 * std::int64_t{n.box.lower[axis]};
      for (std::uint32_t i = 0; i < count; ++i) {
        keys[i] = static_cast<std::uint64_t>(centre(items[i], axis) - first) << item_bits | items[i];
      }
      std::sort(keys.begin(), keys.begin() + count);
      StepBox box;
      for (std::uint32_t i = 0; i < count; ++i) {
        box.include(boxes_[keys[i] & item_mask]);
        area_left[i] = box.half_area(options_.margin);
      }
      box = {};
      for (std::uint32_t i = count - 1; i > 0; --i) {
        box.include(boxes_[keys[i] & item_mask]);
        const double cost = area_left[i - 1] * tests(i) + box.half_area(options_.margin) * tests(count - i);
        if (cost < best_cost) {
          best_cost = cost;
          best_axis = axis;
          best_position = i;
        }
      }
    }
    for (std::uint32_t i = 0; i < count; ++i) items[i] = static_cast<std::uint32_t>(sorted[best_axis][i] & item_mask);
    return n.begin + best_position;
  }

  [[nodiscard]] Split best_binned(const BinaryNode& n) const {
    Split best;
    std::array<std::int64_t, 3> lower{}, width{};
    lower.fill(std::numeric_limits<std::int64_t>::max());
    std::array<std::int64_t, 3> upper{};
    upper.fill(std::numeric_limits<std::int64_t>::min());
    for (std::uint32_t i = n.begin; i < n.end; ++i) {
      for (int k = 0; k < 3; ++k) {
        const std::int64_t c = centre(tree_.order[i], k);
        lower[k] = std::min(lower[k], c);
        upper[k] = std::max(upper[k], c);
      }
    }
    for (int k = 0; k < 3; ++k) width[k] = (upper[k] - lower[k]) / kBins + 1;
    struct Bin {
      StepBox box;
      std::uint32_t count = 0;
    };
    std::array<std::array<Bin, kBins>, 3> bins{};
    const std::array<double, 3> inverse{1.0 / double(width[0]), 1.0 / double(width[1]), 1.0 / double(width[2])};
    for (std::uint32_t i = n.begin; i < n.end; ++i) {
      const std::uint32_t item = tree_.order[i];
      for (int k = 0; k < 3; ++k) {
        Bin& bin = bins[k][std::min(kBins - 1, int(double(centre(item, k) - lower[k]) * inverse[k]))];
        bin.box.include(boxes_[item]);
        ++bin.count;
      }
    }
    for (int k = 0; k < 3; ++k) {
      std::array<double, kBins> cost_left{};
      StepBox box;
      std::uint32_t count = 0;
      for (int b = 0; b < kBins; ++b) {
        box.include(bins[k][b].box);
        count += bins[k][b].count;
        cost_left[b] = count == 0 ? 0.0 : box.half_area(options_.margin) * tests(count);
      }
      const std::uint32_t total = count;
      box = {};
      count = 0;
      for (int b = kBins - 1; b > 0; --b) {
        box.include(bins[k][b].box);
        count += bins[k][b].count;
        if (count == 0 || count == total) continue;
        const double cost = cost_left[b - 1] + box.half_area(options_.margin) * tests(count);
        if (cost < best.cost) best = {cost, k, first_of_bin(lower[k], inverse[k], b)};
      }
    }
    return best;
  }

  /// The least centre that falls in bin `b`, by the same arithmetic that sorts items into bins.
  static std::int64_t first_of_bin(std::int64_t lower, double inverse, int b) {
    auto offset = static_cast<std::int64_t>(double(b) / inverse);
    while (offset > 0 && int(double(offset - 1) * inverse) >= b) --offset;
    while (int(double(offset) * inverse) < b) ++offset;
    return lower + offset;
  }

  std::span<const StepBox> boxes_;
  const BinaryTreeOptions& options_;
  BinaryTree tree_;
};

}  // namespace

BinaryTree build_binary_tree(std::span<const StepBox> boxes, const BinaryTreeOptions& options) {
  return Builder(boxes, options).run();
}

}  // namespace roam::index
