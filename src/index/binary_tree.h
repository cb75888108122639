#pragma once
/// \file
/// A binary tree over boxes by the surface area heuristic (Wald, "On fast construction of SAH-based bounding volume
/// hierarchies", 2007): the first half of building a tile. collapse.h is the second.

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
  /// The heuristic's cost of n items is that of n rounded up to a multiple of this, a power of two: what
  /// a leaf test costs.
  std::uint32_t items_per_test = node_width;
  /// Steps by which a query grows the boxes, in all: the chance of a visit goes with the area of the grown box. More
  /// than 0, or flat scenes leave the heuristic without a preference.
  double margin = 1.0;
  /// Whether these items may form a leaf. Must hold for a single item.
  std::function<bool(std::span<const std::uint32_t>)> fits_leaf;
};

/// The depth below which splits are balanced, whatever they cost: it bounds the depth-first part of a traversal's
/// stack.
inline constexpr int sah_depth = 40;
/// No tree is deeper: at most 2^24 items, halved below sah_depth.
inline constexpr int max_depth = sah_depth + 24;

/// Deterministic: depends on the boxes and their order only. `boxes` holds 1 to 2^24 boxes, whose
/// coordinates are from 0 to 2^30 - 1.
[[nodiscard]] BinaryTree build_binary_tree(std::span<const StepBox> boxes, const BinaryTreeOptions& options);

}  // namespace roam::index
