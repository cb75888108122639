#include "index/collapse.h"

#include <algorithm>
#include <array>

#include "index/refit.h"

namespace roam::index {
namespace {

/// Cost of visiting one more node, in mean leaf areas, whatever its size: nodes take memory too.
constexpr double leaves_per_node = 4.0;

/// For each binary node, the least cost of its subtree when it may fill up to k of its parent's slots.
struct Plan {
  std::array<float, node_width + 1> cost{};         ///< cost[k], k = 1 .. 16
  std::array<std::uint8_t, node_width + 1> left{};  ///< slots of the left child; 0: the node itself takes one slot
  std::uint8_t left_own = 0;                        ///< the left child's share of the node's own sixteen slots
};

std::vector<Plan> plan(const BinaryTree& tree, double margin) {
  double leaf_area = 0.0;
  std::size_t leaf_count = 0;
  for (const BinaryNode& n : tree.nodes) {
    if (n.left < 0) {
      leaf_area += n.box.half_area(margin);
      ++leaf_count;
    }
  }
  const double per_node = leaves_per_node * leaf_area / double(leaf_count);
  std::vector<Plan> plans(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {  // children come after their parent
    const BinaryNode& n = tree.nodes[i];
    if (n.left < 0) continue;
    Plan& p = plans[i];
    const Plan& l = plans[n.left];
    const Plan& r = plans[n.left + 1];
    const auto share = [&](int slots) {
      std::pair<float, int> best{l.cost[1] + r.cost[slots - 1], 1};
      for (int k = 2; k < slots; ++k) {
        const float cost = l.cost[k] + r.cost[slots - k];
        if (cost < best.first) best = {cost, k};
      }
      return best;
    };
    const auto own = share(node_width);
    p.left_own = static_cast<std::uint8_t>(own.second);
    p.cost[1] = static_cast<float>(n.box.half_area(margin) + per_node) + own.first;
    for (int slots = 2; slots <= node_width; ++slots) {
      const auto shared = slots == node_width ? own : share(slots);
      const bool open = shared.first < p.cost[1];
      p.cost[slots] = open ? shared.first : p.cost[1];
      p.left[slots] = static_cast<std::uint8_t>(open ? shared.second : 0);
    }
  }
  return plans;
}

void gather(const BinaryTree& tree, const std::vector<Plan>& plans, std::int32_t index, int slots,
            std::vector<std::int32_t>& children) {
  const BinaryNode& n = tree.nodes[index];
  const int left = n.left < 0 ? 0 : plans[index].left[slots];
  if (left == 0) {
    children.push_back(index);
    return;
  }
  gather(tree, plans, n.left, left, children);
  gather(tree, plans, n.left + 1, slots - left, children);
}

}  // namespace

WideTree collapse(const BinaryTree& tree, double margin) {
  const std::vector<Plan> plans = plan(tree, margin);
  WideTree wide;
  wide.nodes.resize(1);
  std::vector<std::pair<std::int32_t, std::uint32_t>> open{{0, 0}};  // binary node, wide node
  std::vector<std::int32_t> children;
  std::vector<StepBox> boxes;
  while (!open.empty()) {
    const auto [index, slot] = open.back();
    open.pop_back();
    const BinaryNode& n = tree.nodes[index];
    children.clear();
    if (n.left < 0) {
      children.push_back(index);  // the root is itself a leaf
    } else {
      const int left = plans[index].left_own;
      gather(tree, plans, n.left, left, children);
      gather(tree, plans, n.left + 1, node_width - left, children);
    }
    const auto first_leaf = std::stable_partition(children.begin(), children.end(),
                                                  [&](std::int32_t c) { return tree.nodes[c].left >= 0; });
    Node node{};
    node.child_count = static_cast<std::uint8_t>(children.size());
    node.inner_count = static_cast<std::uint8_t>(first_leaf - children.begin());
    node.first_node = static_cast<std::uint32_t>(wide.nodes.size());
    node.first_leaf = static_cast<std::uint32_t>(wide.leaves.size());
    boxes.clear();
    for (const auto c : children) boxes.push_back(tree.nodes[c].box);
    set_boxes(node, boxes);
    wide.nodes[slot] = node;
    wide.nodes.resize(wide.nodes.size() + node.inner_count);
    for (std::size_t i = node.inner_count; i < children.size(); ++i) {
      wide.leaves.push_back(static_cast<std::uint32_t>(children[i]));
    }
    for (std::size_t i = node.inner_count; i-- > 0;) {
      open.push_back({children[i], node.first_node + static_cast<std::uint32_t>(i)});
    }
  }
  return wide;
}

WideTree tree_over(std::span<const StepBox> boxes) {
  BinaryTreeOptions options;
  options.items_per_test = 1;
  options.fits_leaf = [](std::span<const std::uint32_t> items) { return items.size() == 1; };
  const BinaryTree tree = build_binary_tree(boxes, options);
  WideTree wide = collapse(tree, options.margin);
  for (std::uint32_t& leaf : wide.leaves) leaf = tree.order[tree.nodes[leaf].begin];
  return wide;
}

}  // namespace roam::index
