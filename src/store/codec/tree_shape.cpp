#include "store/codec/tree_shape.h"

#include <cstring>

#include "index/refit.h"

namespace roam::store {

using index::Leaf;
using index::Node;
using index::node_width;
using index::StepBox;

namespace {

struct Counts {
  std::uint8_t children, inner;
};
constexpr auto counts_of_letters() {
  std::array<Counts, node_width*(node_width + 3) / 2> table{};
  std::size_t letter = 0;
  for (std::uint8_t children = 1; children <= node_width; ++children) {
    for (std::uint8_t inner = 0; inner <= children; ++inner) table[letter++] = {children, inner};
  }
  return table;
}
constexpr auto letter_counts = counts_of_letters();

/// Eight numbers in one vector register, by the extension that GCC and Clang share. They are signed because the oldest
/// vector units of x86 have a minimum of 16-bit numbers only for signed ones.
using Lanes [[gnu::vector_size(16)]] = std::int16_t;

Lanes least(Lanes a, Lanes b) { return a < b ? a : b; }

/// The lesser of lanes i and i + 4 of a, and of b: four of each, alternating.
Lanes narrow(Lanes a, Lanes b) {
  return least(__builtin_shufflevector(a, b, 0, 8, 1, 9, 2, 10, 3, 11),
               __builtin_shufflevector(a, b, 4, 12, 5, 13, 6, 14, 7, 15));
}

/// The box of a leaf's vertices. All sixteen are used, because unused ones repeat the first.
StepBox box_of(const Leaf& leaf) {
  std::array<Lanes, 3> lower, upper;
  for (int k = 0; k < 3; ++k) {
    Lanes a, b;
    std::memcpy(&a, leaf.vertex[k], sizeof(a));
    std::memcpy(&b, leaf.vertex[k] + 8, sizeof(b));
    a ^= INT16_MIN;
    b ^= INT16_MIN;
    lower[k] = least(a, b);
    upper[k] = least(~a, ~b);  // the complement of the greatest
  }
  const Lanes x = narrow(lower[0], upper[0]), y = narrow(lower[1], upper[1]), z = narrow(lower[2], upper[2]);
  const Lanes all = narrow(narrow(x, z), narrow(y, z));  // lower x, y, z, z, then upper
  StepBox box;
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = all[k] + 0x8000;
    box.upper[k] = ~all[k + 4] + 0x8000;
  }
  return box;
}

}  // namespace

const char* TreeBuilder::topology(std::span<const std::byte> letters, std::span<Node> nodes, std::size_t leaves) {
  std::size_t next_node = 1, next_leaf = 0, open = 1;
  open_[0] = 0;
  depth_[0] = 0;
  for (const std::byte letter : letters) {
    if (open == 0) return "its tree ends early";
    const std::uint16_t at = open_[--open];
    const std::uint8_t depth = depth_[at];
    const auto number = std::to_integer<std::size_t>(letter);
    if (number >= letter_counts.size()) return "a node has a wrong number of children";
    const std::uint32_t children = letter_counts[number].children, inner = letter_counts[number].inner;
    if (next_node + inner > nodes.size() || next_leaf + children - inner > leaves) {
      return "its tree has more children than it has room for";
    }
    if (inner > 0 && depth >= index::max_depth) return "its tree is too deep";
    Node& node = nodes[at];
    node = {};
    node.child_count = static_cast<std::uint8_t>(children);
    node.inner_count = static_cast<std::uint8_t>(inner);
    node.first_node = static_cast<std::uint32_t>(next_node);
    node.first_leaf = static_cast<std::uint32_t>(next_leaf);
    for (std::uint32_t i = inner; i-- > 0;) {
      open_[open++] = static_cast<std::uint16_t>(next_node + i);
      depth_[next_node + i] = static_cast<std::uint8_t>(depth + 1);
    }
    next_node += inner;
    next_leaf += children - inner;
  }
  return open == 0 && next_node == nodes.size() && next_leaf == leaves ? nullptr : "its tree is not complete";
}

void TreeBuilder::refit(std::span<Node> nodes, std::span<const Leaf> leaves) {
  std::array<StepBox, node_width> children;
  for (std::size_t i = nodes.size(); i-- > 0;) {
    Node& node = nodes[i];
    for (std::uint32_t c = 0; c < node.inner_count; ++c) children[c] = boxes_[node.first_node + c];
    for (std::uint32_t c = node.inner_count; c < node.child_count; ++c) {
      children[c] = box_of(leaves[node.first_leaf + c - node.inner_count]);
    }
    boxes_[i] = index::set_boxes(node, {children.data(), node.child_count});
  }
}

}  // namespace roam::store
