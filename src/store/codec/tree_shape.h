#pragma once
/// \file
/// The tree of a tile as two counts for each node, and its reconstruction with child numbers and boxes.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "index/binary_tree.h"
#include "index/block.h"
#include "store/codec/tile_codec.h"

namespace roam::store {

/// Upper bound of a tile's blocks.
inline constexpr std::size_t tile_blocks = tile_bytes / sizeof(index::Block);

/// The counts of a node as one letter: the pairs (children, inner children), enumerated.
[[nodiscard]] inline std::uint8_t node_letter(const index::Node& node) {
  const unsigned c = node.child_count;
  return static_cast<std::uint8_t>(c * (c + 1) / 2 - 1 + node.inner_count);
}

/// Reconstructs the nodes of tiles. Its memory is reused.
class TreeBuilder {
 public:
  /// Makes the nodes without their boxes, numbered as collapse() does: depth first, each node takes the next numbers
  /// for its inner children and for its leaves. Returns null, or the reason why the letters are no tree of exactly this
  /// many nodes and leaves with a depth of at most index::max_depth.
  [[nodiscard]] const char* topology(std::span<const std::byte> letters, std::span<index::Node> nodes,
                                     std::size_t leaves);

  /// Sets the boxes of the nodes. Children must come after their parents.
  void refit(std::span<index::Node> nodes, std::span<const index::Leaf> leaves);

 private:
  std::array<std::uint16_t, tile_blocks> open_;  ///< nodes to visit
  std::array<std::uint8_t, tile_blocks> depth_;
  std::array<index::StepBox, tile_blocks> boxes_;
};

/// Visits the nodes of a built tile in the order of topology().
template <class Visit>
void visit_depth_first(std::span<const index::Node> nodes, std::uint32_t at, Visit&& visit) {
  visit(nodes[at]);
  for (std::uint32_t i = 0; i < nodes[at].inner_count; ++i) visit_depth_first(nodes, nodes[at].first_node + i, visit);
}

}  // namespace roam::store
