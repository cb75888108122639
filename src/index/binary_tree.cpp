#include "index/binary_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <limits>

namespace roam::index {
namespace {

constexpr int bin_count = 16;
/// For up to this many items every split position is tried, without bins.
constexpr std::uint32_t exact_below = 64;

/// All axes in one vector, a type of g++ and clang. The last element of lower bounds and the first of upper bounds have
/// no meaning.
using Four = std::int32_t __attribute__((vector_size(16)));

Four lower_of(const StepBox& box) {
  Four four;
  std::memcpy(&four, &box, sizeof four);
  return four;
}
Four upper_of(const StepBox& box) {
  static_assert(offsetof(StepBox, upper) == 12 && sizeof(StepBox) == 24);
  Four four;
  std::memcpy(&four, reinterpret_cast<const char*>(&box) + 8, sizeof four);
  return four;
}
/// Doubled centres, which are integers.
Four centres_of(const StepBox& box) {
  const Four upper = upper_of(box);
  return lower_of(box) + __builtin_shufflevector(upper, upper, 1, 2, 3, 3);
}
Four least(const Four& a, const Four& b) { return a < b ? a : b; }
Four most(const Four& a, const Four& b) { return a > b ? a : b; }

/// A box that grows: StepBox::include.
class Bounds {
 public:
  void include(const StepBox& box) { include(lower_of(box), upper_of(box)); }
  void include(const Bounds& other) { include(other.lower_, other.upper_); }
  [[nodiscard]] StepBox box() const { return {{lower_[0], lower_[1], lower_[2]}, {upper_[1], upper_[2], upper_[3]}}; }
  [[nodiscard]] double half_area(double margin) const { return box().half_area(margin); }

 private:
  void include(const Four& lower, const Four& upper) {
    lower_ = least(lower, lower_);
    upper_ = most(upper, upper_);
  }

  Four lower_{INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX};
  Four upper_{INT32_MIN, INT32_MIN, INT32_MIN, INT32_MIN};
};

struct Split {
  double cost = std::numeric_limits<double>::infinity();
  int axis = -1;
  std::int64_t position = 0;  ///< items with a smaller doubled centre go left
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
    build_below(0, 0);
    return std::move(tree_);
  }

 private:
  [[nodiscard]] std::int64_t centre(std::uint32_t item, int axis) const {  // doubled
    return std::int64_t{boxes_[item].lower[axis]} + boxes_[item].upper[axis];
  }

  [[nodiscard]] double tests(std::uint32_t items) const {
    return double((items + options_.items_per_test - 1) >> tests_shift_);
  }

  /// Divides a node and its descendants until they fit leaves.
  void build_below(std::int32_t root, int root_depth) {
    std::vector<std::pair<std::int32_t, int>> open{{root, root_depth}};
    while (!open.empty()) {
      const auto [index, depth] = open.back();
      open.pop_back();
      const BinaryNode n = tree_.nodes[index];
      if (fits_leaf(n)) continue;
      if (n.end - n.begin <= exact_below && depth < sah_depth) {
        Few few(*this, n);
        few.divide(index, depth, few.all());
        continue;
      }
      const std::int32_t left = divide_at(index, divide(n, depth));
      open.push_back({left + 1, depth + 1});
      open.push_back({left, depth + 1});
    }
  }

  [[nodiscard]] bool fits_leaf(const BinaryNode& n) const {
    return options_.fits_leaf({tree_.order.data() + n.begin, n.end - n.begin});
  }

  [[nodiscard]] BinaryNode node(std::uint32_t begin, std::uint32_t end) const {
    Bounds bounds;
    for (std::uint32_t i = begin; i < end; ++i) bounds.include(boxes_[tree_.order[i]]);
    return {bounds.box(), -1, begin, end};
  }

  /// Gives a node two children and returns the number of the left one.
  std::int32_t divide_at(std::int32_t index, std::uint32_t middle) {
    const auto left = static_cast<std::int32_t>(tree_.nodes.size());
    const std::uint32_t begin = tree_.nodes[index].begin, end = tree_.nodes[index].end;
    tree_.nodes[index].left = left;
    tree_.nodes.push_back(node(begin, middle));
    tree_.nodes.push_back(node(middle, end));
    return left;
  }

  /// Reorders the items of `n` into two parts and returns the beginning of the second.
  std::uint32_t divide(const BinaryNode& n, int depth) {
    if (depth < sah_depth) {
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

  /// A node of few items with its descendants: every position between two centres is tried on each axis. The items are
  /// sorted once, because parts of a sorted sequence stay sorted.
  class Few {
   public:
    /// Item numbers sorted by centre on each axis: an index into boxes_ in the low bits, the centre above it.
    using Sorted = std::array<std::array<std::uint64_t, exact_below>, 3>;

    Few(Builder& builder, const BinaryNode& n) : builder_(builder) {
      count_ = n.end - n.begin;
      const auto first = builder.tree_.order.begin() + n.begin;
      std::copy(first, first + count_, items_.begin());
      std::sort(items_.begin(), items_.begin() + count_);  // at equal centres the lower item comes first
      for (std::uint32_t i = 0; i < count_; ++i) boxes_[i] = builder.boxes_[items_[i]];
      for (int axis = 0; axis < 3; ++axis) {
        auto& keys = all_[axis];
        const std::int64_t least = 2 * std::int64_t{n.box.lower[axis]};
        for (std::uint32_t i = 0; i < count_; ++i) {
          const std::int64_t centre = std::int64_t{boxes_[i].lower[axis]} + boxes_[i].upper[axis];
          keys[i] = static_cast<std::uint64_t>(centre - least) << bit_count | i;
        }
        std::sort(keys.begin(), keys.begin() + count_);
      }
      if (!builder.options_.vertices.empty()) number_vertices();
    }
    [[nodiscard]] const Sorted& all() const { return all_; }

    /// Divides a node that does not fit a leaf, and its descendants, until all fit.
    void divide(std::int32_t index, int depth, const Sorted& sorted) {
      const BinaryNode n = builder_.tree_.nodes[index];
      const std::uint32_t count = n.end - n.begin;
      const auto [axis, position] = best(sorted, count);
      std::uint32_t* const order = builder_.tree_.order.data() + n.begin;
      std::uint64_t right = 0;
      for (std::uint32_t i = 0; i < count; ++i) {
        const auto number = sorted[axis][i] & mask;
        order[i] = items_[number];
        right |= std::uint64_t{i >= position} << number;
      }
      const std::int32_t left = builder_.divide_at(index, n.begin + position);
      for (const std::int32_t child : {left, left + 1}) {
        const BinaryNode half = builder_.tree_.nodes[child];
        if (builder_.fits_leaf(half)) continue;
        if (depth + 1 == sah_depth) {
          builder_.build_below(child, depth + 1);
          continue;
        }
        Sorted its;
        for (int k = 0; k < 3; ++k) {
          std::uint32_t found = 0;
          for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint64_t key = sorted[k][i];
            if ((right >> (key & mask) & 1U) == std::uint64_t(child - left)) its[k][found++] = key;
          }
        }
        divide(child, depth + 1, its);
      }
    }

   private:
    /// Numbers the vertices of the items from 0, by a hash table.
    void number_vertices() {
      constexpr std::uint32_t slots = 512, empty = ~0U;
      std::array<std::uint32_t, slots> keys;
      std::array<std::uint8_t, slots> numbers;
      keys.fill(empty);
      std::uint8_t found = 0;
      for (std::uint32_t i = 0; i < count_; ++i) {
        for (int c = 0; c < 3; ++c) {
          const std::uint32_t key = builder_.options_.vertices[items_[i]][c];
          std::uint32_t slot = key % slots;
          while (keys[slot] != empty && keys[slot] != key) slot = (slot + 1) % slots;
          if (keys[slot] == empty) {
            keys[slot] = key;
            numbers[slot] = found++;
          }
          vertex_[i][c] = numbers[slot];
        }
      }
    }

    /// Distinct vertices of a growing set of items.
    class Vertices {
     public:
      void include(const std::array<std::uint8_t, 3>& corners) {
        for (const std::uint8_t v : corners) {
          std::uint64_t& word = seen_[v / 64];
          const std::uint64_t bit = std::uint64_t{1} << v % 64;
          count_ += (word & bit) == 0 ? 1 : 0;
          word |= bit;
        }
      }
      [[nodiscard]] std::uint32_t count() const { return count_; }

     private:
      std::array<std::uint64_t, 3> seen_{};
      std::uint32_t count_ = 0;
    };

    static constexpr int bit_count = 6;
    static constexpr std::uint64_t mask = (1U << bit_count) - 1;
    static_assert(exact_below <= 1U << bit_count);

    [[nodiscard]] std::pair<int, std::uint32_t> best(const Sorted& sorted, std::uint32_t count) const {
      const double margin = builder_.options_.margin;
      std::array<double, exact_below> cost_left{};
      double best_cost = std::numeric_limits<double>::infinity();
      std::pair<int, std::uint32_t> best{0, count / 2};
      for (int axis = 0; axis < 3; ++axis) {
        const auto& keys = sorted[axis];
        Bounds bounds;
        Vertices vertices;
        for (std::uint32_t i = 0; i < count; ++i) {
          bounds.include(boxes_[keys[i] & mask]);
          vertices.include(vertex_[keys[i] & mask]);
          cost_left[i] = bounds.half_area(margin) * builder_.tests(std::max(i + 1, vertices.count()));
        }
        bounds = {};
        vertices = {};
        for (std::uint32_t i = count - 1; i > 0; --i) {
          bounds.include(boxes_[keys[i] & mask]);
          vertices.include(vertex_[keys[i] & mask]);
          const double cost =
              cost_left[i - 1] + bounds.half_area(margin) * builder_.tests(std::max(count - i, vertices.count()));
          if (cost < best_cost) {
            best_cost = cost;
            best = {axis, i};
          }
        }
      }
      return best;
    }

    Builder& builder_;
    std::uint32_t count_ = 0;
    std::array<std::uint32_t, exact_below> items_;
    std::array<StepBox, exact_below> boxes_;
    std::array<std::array<std::uint8_t, 3>, exact_below> vertex_{};  ///< all 0 if options_ has none
    Sorted all_;
  };

  [[nodiscard]] Split best_binned(const BinaryNode& n) const {
    Split best;
    Four lower{INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX}, upper{INT32_MIN, INT32_MIN, INT32_MIN, INT32_MIN};
    for (std::uint32_t i = n.begin; i < n.end; ++i) {
      const Four centres = centres_of(boxes_[tree_.order[i]]);
      lower = least(centres, lower);
      upper = most(centres, upper);
    }
    struct Bin {
      Bounds box;
      std::uint32_t count = 0;
    };
    std::array<std::array<Bin, bin_count>, 3> bins{};
    std::array<double, 3> inverse{};
    for (int k = 0; k < 3; ++k) inverse[k] = 1.0 / double((upper[k] - lower[k]) / bin_count + 1);
    for (std::uint32_t i = n.begin; i < n.end; ++i) {
      const StepBox& box = boxes_[tree_.order[i]];
      const Four centres = centres_of(box) - lower;
      for (int k = 0; k < 3; ++k) {
        Bin& bin = bins[k][std::min(bin_count - 1, int(double(centres[k]) * inverse[k]))];
        bin.box.include(box);
        ++bin.count;
      }
    }
    for (int k = 0; k < 3; ++k) {
      std::array<double, bin_count> cost_left{};
      Bounds box;
      std::uint32_t count = 0;
      for (int b = 0; b < bin_count; ++b) {
        box.include(bins[k][b].box);
        count += bins[k][b].count;
        cost_left[b] = count == 0 ? 0.0 : box.half_area(options_.margin) * tests(count);
      }
      const std::uint32_t total = count;
      box = {};
      count = 0;
      for (int b = bin_count - 1; b > 0; --b) {
        box.include(bins[k][b].box);
        count += bins[k][b].count;
        if (count == 0 || count == total) continue;
        const double cost = cost_left[b - 1] + box.half_area(options_.margin) * tests(count);
        if (cost < best.cost) best = {cost, k, first_of_bin(lower[k], inverse[k], b)};
      }
    }
    return best;
  }

  /// The least centre that falls into bin `b`, by the same arithmetic that assigns items to bins.
  static std::int64_t first_of_bin(std::int64_t lower, double inverse, int b) {
    auto offset = static_cast<std::int64_t>(double(b) / inverse);
    while (offset > 0 && int(double(offset - 1) * inverse) >= b) --offset;
    while (int(double(offset) * inverse) < b) ++offset;
    return lower + offset;
  }

  std::span<const StepBox> boxes_;
  const BinaryTreeOptions& options_;
  /// items_per_test is a power of two.
  const int tests_shift_ = std::countr_zero(options_.items_per_test);
  BinaryTree tree_;
};

}  // namespace

BinaryTree build_binary_tree(std::span<const StepBox> boxes, const BinaryTreeOptions& options) {
  return Builder(boxes, options).run();
}

}  // namespace roam::index
