#pragma once
/// \file
/// A tree over the boxes of many worlds. It finds those that may concern a query, nearest first.
///
/// It drops only boxes that are out of reach by at least a millimetre (box_slack). This is far more than any rounding
/// here: coordinates are at most 1e9 m, and motions 1e6 m.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "roam/math.h"

namespace roam {

/// Metres. Boxes are tested this much larger than they are.
inline constexpr double box_slack = 1e-3;

/// The times of a motion between which something may be within reach; empty if begin > end.
struct Interval {
  double begin = 0.0, end = 1.0;
  [[nodiscard]] bool empty() const { return begin > end; }
};

/// A point that moves from `from` by `motion`, with everything at most `reach` from it along each axis (m).
struct Sweep {
  Vec3 from, motion, reach;

  /// The times at which it may meet the box (Kay and Kajiya, "Ray tracing complex scenes", 1986). The rounding of a
  /// time moves the point by less than box_slack.
  [[nodiscard]] Interval meets(const Box& box) const {
    Interval when;
    for (int k = 0; k < 3; ++k) {
      const double lower = box.lower[k] - reach[k] - box_slack - from[k];
      const double upper = box.upper[k] + reach[k] + box_slack - from[k];
      if (motion[k] == 0.0) {
        if (lower > 0.0 || upper < 0.0) return {1.0, 0.0};
        continue;
      }
      const double a = lower / motion[k], b = upper / motion[k];
      when.begin = std::max(when.begin, std::min(a, b));
      when.end = std::min(when.end, std::max(a, b));
    }
    return when;
  }

  /// Squared distance of its start from the box, m^2.
  [[nodiscard]] double distance_squared(const Box& box) const {
    double squared = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double apart = std::max({box.lower[k] - from[k], from[k] - box.upper[k], 0.0});
      squared += apart * apart;
    }
    return squared;
  }
};

class BoxTree {
 public:
  /// A box and the number of its owner.
  struct Item {
    Box box;
    std::uint32_t number;
  };

  /// Puts the items of `put`, each in place of the item with the same number, and removes the numbers in `erased`. No
  /// number may occur twice. A few changes cost a walk down the tree each. Many changes, or a tree that has become too
  /// deep, rebuild it. After std::bad_alloc nothing has changed.
  void change(const std::vector<Item>& put, const std::vector<std::uint32_t>& erased);

  /// The box of all items; empty if there are none.
  [[nodiscard]] Box bounds() const { return root_ == none ? Box{} : nodes_[root_].box; }

  /// Visits the items that the sweep may meet, earliest first, up to the time `until`, which the visitor may lower:
  /// visit(number, when).
  template <class Visit>
  void along(const Sweep& sweep, const double& until, Visit&& visit) const {
    traverse(
        [&](const Box& box) {
          const Interval when = sweep.meets(box);
          return Key{when.begin <= until ? when : Interval{1.0, 0.0}, when.begin};
        },
        [&](const Interval& when) { return when.begin <= until; }, visit);
  }

  /// Visits the items that the sweep may meet, those nearest to its start first: visit(number, when). `sweep` is read
  /// again for each item, so that the visitor may lower its reach.
  template <class Visit>
  void near(const Sweep& sweep, Visit&& visit) const {
    traverse(
        [&](const Box& box) {
          return Key{sweep.meets(box), sweep.distance_squared(box)};
        },
        [](const Interval&) { return true; }, visit);
  }

 private:
  static constexpr std::uint32_t none = UINT32_MAX;
  struct Node {
    Box box;
    std::uint32_t parent = none;
    std::uint32_t left = none, right = none;  ///< none: a leaf
    std::uint32_t number = none;              ///< if it is a leaf
    std::uint32_t height = 0;                 ///< height of the tree below the node
    [[nodiscard]] bool leaf() const { return left == none; }
  };
  struct Key {
    Interval when;
    double order;
  };
  /// A tree with more levels is rebuilt. Halving 2^32 items takes 33.
  static constexpr std::uint32_t deepest_tree = 40;
  /// If more than 1 / many_part of the items change, a new tree costs less than repairing the old one.
  static constexpr std::size_t many_part = 4;

  template <class Look, class Still, class Visit>
  void traverse(const Look& look, const Still& still, Visit& visit) const {
    struct Entry {
      std::uint32_t node;
      Interval when;
    };
    if (root_ == none) return;
    std::array<Entry, deepest_tree + 2> stack;
    std::size_t size = 0;
    if (const Key root = look(nodes_[root_].box); !root.when.empty()) stack[size++] = {root_, root.when};
    while (size > 0) {
      const Entry entry = stack[--size];
      const Node& node = nodes_[entry.node];
      if (!still(entry.when)) continue;
      if (node.leaf()) {
        // The visitor may have lowered its limits since the box was pushed.
        if (const Key again = look(node.box); !again.when.empty()) visit(node.number, again.when);
        continue;
      }
      const Key a = look(nodes_[node.left].box), b = look(nodes_[node.right].box);
      const bool left_first = a.order <= b.order;
      const Entry first = left_first ? Entry{node.left, a.when} : Entry{node.right, b.when};
      const Entry second = left_first ? Entry{node.right, b.when} : Entry{node.left, a.when};
      if (!second.when.empty()) stack[size++] = second;
      if (!first.when.empty()) stack[size++] = first;
    }
  }

  /// For a change that puts these items, to so many nodes in all. Nothing else allocates.
  void make_room(const std::vector<Item>& put, std::size_t nodes);
  void build(std::vector<Item>& items);
  std::uint32_t split(std::vector<Item>& items, std::size_t begin, std::size_t end);
  void insert(const Item& item);
  void erase(std::uint32_t number);
  std::uint32_t make(const Node& node);
  void link(std::uint32_t parent, std::uint32_t old_child, std::uint32_t child);
  void fit_upward(std::uint32_t node);
  void fit(std::uint32_t node);
  void add_items(std::vector<Item>& to) const;
  [[nodiscard]] std::uint32_t leaf_of(std::uint32_t number) const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> unused_;  ///< free nodes
  std::vector<std::uint32_t> leaves_;  ///< by number; none if there is no such item
  std::uint32_t root_ = none;
  std::size_t size_ = 0;  ///< number of items
};

}  // namespace roam
