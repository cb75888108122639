#pragma once
/// \file
/// What the bytes of a tile hold: numbers of variable length, then one Zstandard frame of streams.

#include <array>
#include <cstddef>
#include <cstdint>

#include "store/codec/front.h"
#include "store/codec/tree_shape.h"

namespace roam::store {

/// The streams, of letters of a byte each but for the last three, in their order in the frame.
enum Stream : std::uint8_t {
  tree_stream,    ///< a letter a node: its counts
  count_stream,  ///< a letter a leaf: triangles - 1
  gate_stream,   ///< three Apex a letter
  seed_stream,   ///< a letter for each triangle without a gate in its leaf: how it is named
  name_stream,   ///< of vertices that are named by slot or age
  gate_x,   ///< classes of differences between a vertex and its prediction beyond a gate
  gate_y,
  gate_z,
  free_x,  ///< the same from the vertex named before
  free_y,
  free_z,
  name_bit_stream,  ///< what follows the classes of ages
  gate_bit_stream,  ///< what follows the classes of a vertex beyond a gate: x, y, z
  free_bit_stream,
  stream_count
};

/// How many letters there are, in the order of the numbers before the frame. Those of tree and leaves are known.
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

/// Letters of seed_stream: a triangle beyond a gate of an earlier leaf, by its Apex - 1; from free_seed the corners of a
/// triangle one by one, plus 1, 2, 4 for those not seen before.
inline constexpr std::uint8_t free_seed = apex_stream - 1;
inline constexpr std::uint8_t seed_letters = free_seed + 8;

/// Letters of name_stream below node_width: the slot in the leaf. Above: the class of the age, 0 for the newest vertex.
inline constexpr std::uint8_t age_name = index::node_width;

/// A tile's vertices are counted in 15 bits, its leaves' slots too.
inline constexpr std::size_t tile_vertices = tile_blocks * index::node_width;

}  // namespace roam::store
