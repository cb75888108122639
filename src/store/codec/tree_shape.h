#pragma once
/// \file
/// The tree of a tile as two counts a node, and the nodes from it: numbers of children and boxes are computed again.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "index/binary_tree.h"
#include "index/block.h"
#include "store/codec/tile_codec.h"

namespace roam::store {

/// A tile has fewer blocks than this.
inline constexpr std::size_t tile_blocks = tile_bytes / sizeof(index::Block);

/// The counts of a node as one letter: pairs (children, inner children) numbered through.
[[nodiscard]] inline std::uint8_t node_letter(const index::Node& node) {
  const unsigned c = node.child_count;
  return static_cast<std::uint8_t>(c * (c + 1) / 2 - 1 + node.inner_count);
}

/// What is needed to make nodes again; its memory is used over and over.
class TreeBuilder {
 public:
  /// Makes the nodes, all but their boxes. They come as collapse() makes them: node after node, depth first, takes the
  /// next numbers for its inner children and for its leaves. Returns null, or why these letters are no tree of exactly
  /// as many nodes and leaves, no deeper than index::max_depth.
  [[nodiscard]] const char* topology(std::span<const std::byte> letters, std::span<index::Node> nodes,
                                     std::size_t leaves);

  /// Sets the boxes of the nodes; children come after their parents.
  void refit(std::span<index::Node> nodes, std::span<const index::Leaf> leaves);

 private:
  std::array<std::uint16_t, tile_blocks> open_;  ///< nodes to visit
  std::array<std::uint8_t, tile_blocks> depth_;
  std::array<index::StepBox, tile_blocks> boxes_;
};

/// The order in which topology() visits the nodes of a tile that was built.
template <class Visit>
void visit_depth_first(std::span<const index::Node> nodes, std::uint32_t at, Visit&& visit) {
  visit(nodes[at]);
  for (std::uint32_t i = 0; i < nodes[at].inner_count; ++i) visit_depth_first(nodes, nodes[at].first_node + i, visit);
}

}  // namespace roam::store
