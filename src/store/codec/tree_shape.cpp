#include "store/codec/tree_shape.h"

#include <algorithm>

#include "index/refit.h"

namespace roam::store {

using index::kWidth;
using index::Leaf;
using index::Node;
using index::StepBox;

namespace {

struct Counts {
  std::uint8_t children, inner;
};
constexpr auto counts_of_letters() {
  std::array<Counts, kWidth*(kWidth + 3) / 2> table{};
  std::size_t letter = 0;
  for (std::uint8_t children = 1; children <= kWidth; ++children) {
    for (std::uint8_t inner = 0; inner <= children; ++inner) table[letter++] = {children, inner};
  }
  return table;
}
constexpr auto kCountsOfLetters = counts_of_letters();

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
    if (number >= kCountsOfLetters.size()) return "a node has a wrong number of children";
    const std::uint32_t children = kCountsOfLetters[number].children, inner = kCountsOfLetters[number].inner;
    if (next_node + inner > nodes.size() || next_leaf + children - inner > leaves) {
      return "its tree has more children than it has room for";
    }
    if (inner > 0 && depth >= index::kMaxDepth) return "its tree is too deep";
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
  std::array<StepBox, kWidth> children;
  for (std::size_t i = nodes.size(); i-- > 0;) {
    Node& node = nodes[i];
    for (std::uint32_t c = 0; c < node.inner_count; ++c) children[c] = boxes_[node.first_node + c];
    for (std::uint32_t c = node.inner_count; c < node.child_count; ++c) {
      const Leaf& leaf = leaves[node.first_leaf + c - node.inner_count];
      for (int k = 0; k < 3; ++k) {
        // Signed numbers, which have minimum and maximum in the oldest vector units.
        std::int16_t lower = INT16_MAX, upper = INT16_MIN;
        for (const std::uint16_t at : leaf.vertex[k]) {
          lower = std::min(lower, static_cast<std::int16_t>(at ^ 0x8000U));
          upper = std::max(upper, static_cast<std::int16_t>(at ^ 0x8000U));
        }
        children[c].lower[k] = lower + 0x8000;
        children[c].upper[k] = upper + 0x8000;
      }
    }
    boxes_[i] = index::set_boxes(node, {children.data(), node.child_count});
  }
}

}  // namespace roam::store
