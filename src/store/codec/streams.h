#pragma once
/// \file
/// The layout of a tile's bytes: numbers of variable length, then one Zstandard frame of streams.

#include <cstddef>
#include <cstdint>

#include "store/codec/front.h"
#include "store/codec/tree_shape.h"

namespace roam::store {

/// The streams in the order of the frame. All consist of letters of one byte, except the last three.
enum Stream : std::uint8_t {
  tree_stream,   ///< one letter for each node: its counts
  count_stream,  ///< one letter for each leaf: triangles - 1
  gate_stream,   ///< three Apex in each letter
  seed_stream,   ///< one letter for each triangle without a gate in its leaf: how it is named
  name_stream,   ///< vertices that are named by slot or age
  gate_x,        ///< classes of differences between a vertex and its prediction beyond a gate
  gate_y,
  gate_z,
  free_x,  ///< classes of differences from the vertex named before
  free_y,
  free_z,
  name_bit_stream,  ///< the bits that follow the classes of ages
  gate_bit_stream,  ///< the bits that follow the classes of a vertex beyond a gate: x, y, z
  free_bit_stream,
  stream_count
};

/// The numbers of letters, in the order in which they precede the frame. Those of tree and leaves follow from the
/// shape.
struct StreamSizes {
  std::uint32_t gates = 0;  ///< letters, not Apex
  std::uint32_t seeds = 0;
  std::uint32_t names = 0;
  std::uint32_t gate_vertices = 0;
  std::uint32_t free_vertices = 0;
  std::uint32_t name_bits = 0;  ///< bytes
  std::uint32_t gate_bits = 0;
  std::uint32_t free_bits = 0;
};

/// Letters of seed_stream. Below free_seed: a triangle beyond a gate of an earlier leaf, as its Apex - 1. From
/// free_seed on: a triangle named corner by corner, plus 1, 2, 4 for the corners that are new.
inline constexpr std::uint8_t free_seed = apex_stream - 1;
inline constexpr std::uint8_t seed_letters = free_seed + 8;

/// Letters of name_stream. Below node_width: the slot in the leaf. From there on: the class of the age, 0 for the
/// newest vertex.
inline constexpr std::uint8_t age_name = index::node_width;

/// Upper bound of a tile's vertices, and of its leaves' slots. Both fit into 15 bits.
inline constexpr std::size_t tile_vertices = tile_blocks * index::node_width;

}  // namespace roam::store
