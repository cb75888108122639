#pragma once
/// \file
/// Child boxes of a node. The builder and every later refit call this function, so that both get the same bits.

#include <cstdint>
#include <span>

#include "index/block.h"

namespace roam::index {

/// Sets origin, shift, lower and upper of a node whose children have these boxes (1 to node_width, in order), rounded
/// outwards to the node's own grid. Returns the box of all.
inline StepBox set_boxes(Node& node, std::span<const StepBox> children) {
  StepBox all;
  for (const StepBox& box : children) all.include(box);
  for (int k = 0; k < 3; ++k) {
    node.origin[k] = all.lower[k];
    const std::int64_t extent = std::int64_t{all.upper[k]} - all.lower[k];
    int shift = 0;
    while ((extent + (std::int64_t{1} << shift) - 1) >> shift > 255) ++shift;
    node.shift[k] = static_cast<std::uint8_t>(shift);
    for (std::size_t i = 0; i < children.size(); ++i) {
      const std::int64_t lower = std::int64_t{children[i].lower[k]} - all.lower[k];
      const std::int64_t upper = std::int64_t{children[i].upper[k]} - all.lower[k];
      node.lower[k][i] = static_cast<std::uint8_t>(lower >> shift);
      node.upper[k][i] = static_cast<std::uint8_t>((upper + (std::int64_t{1} << shift) - 1) >> shift);
    }
  }
  return all;
}

}  // namespace roam::index
