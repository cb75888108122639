#pragma once
/// \file
/// A binary tree over boxes by the surface area heuristic (Wald, "On fast construction of SAH-based bounding volume
/// hierarchies", 2007): the first half of building a tile. collapse.h is the second.

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "index/block.h"

namespace roam::index {

struct BinaryNode {
  StepBox box;
  std::int32_t left = -1;   ///< -1: a leaf; else left and left + 1 are the children
  std::uint32_t begin = 0;  ///< its items are order[begin .. end)
  std::uint32_t end = 0;
};

struct BinaryTree {
  std::vector<BinaryNode> nodes;     ///< nodes[0] is the root
  std::vector<std::uint32_t> order;  ///< a permutation of the items
};

struct BinaryTreeOptions {
  /// The heuristic rounds the number of items of a leaf up to a multiple of this, the items of one leaf test. A power
  /// of two.
  std::uint32_t items_per_test = node_width;
  /// Steps by which a query grows the boxes, in total: the chance of a visit is proportional to the area of the grown
  /// box. Must be more than 0, or the heuristic has no preference in flat scenes.
  double margin = 1.0;
  /// Of each item, if leaves hold at most items_per_test vertices too; else empty. The heuristic counts different
  /// numbers. Two vertices with one number only make a leaf look less full.
  std::span<const std::array<std::uint32_t, 3>> vertices;
  /// Whether these items may form a leaf. Must hold for a single item.
  std::function<bool(std::span<const std::uint32_t>)> fits_leaf;
};

/// Splits deeper than this are balanced, whatever they cost. This bounds the depth-first part of a traversal's stack.
inline constexpr int sah_depth = 40;
/// Greatest depth of a tree: at most 2^24 items are halved below sah_depth.
inline constexpr int max_depth = sah_depth + 24;

/// Deterministic: the result depends only on the boxes and their order. `boxes` holds 1 to 2^24 boxes with coordinates
/// from 0 to 2^30 - 1.
[[nodiscard]] BinaryTree build_binary_tree(std::span<const StepBox> boxes, const BinaryTreeOptions& options);

}  // namespace roam::index
