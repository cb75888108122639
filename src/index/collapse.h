#pragma once
/// \file
/// Collapse of a binary tree into a tree with sixteen children per node, each node one block.

#include <cstdint>
#include <span>
#include <vector>

#include "index/binary_tree.h"
#include "index/block.h"

namespace roam::index {

struct WideTree {
  std::vector<Node> nodes;            ///< nodes[0] is the root; first_node and first_leaf count from 0
  std::vector<std::uint32_t> leaves;  ///< binary leaves (indices into BinaryTree::nodes) in order of first_leaf
};

/// Chooses the surviving binary nodes by dynamic programming over the number of child slots, so that the expected cost
/// of visits is least. The idea is that of Ylitie et al., "Efficient incoherent ray traversal on GPUs through
/// compressed wide BVHs", 2017, here with sixteen children. The leaves are those of the binary tree; `margin` as in
/// BinaryTreeOptions.
[[nodiscard]] WideTree collapse(const BinaryTree& tree, double margin);

/// The collapsed tree over boxes, each of which is a leaf. `leaves` holds their indices.
[[nodiscard]] WideTree tree_over(std::span<const StepBox> boxes);

}  // namespace roam::index
