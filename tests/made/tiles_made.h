#pragma once
/// \file
/// Tiles to encode, for tests and benchmarks: what decoding them must give, and what makes a tile safe to walk.

#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "index/binary_tree.h"
#include "index/partition.h"
#include "index/tile_builder.h"
#include "store/codec/frame.h"
#include "store/codec/tile_codec.h"

namespace store_codec {

using roam::index::Block;
using roam::index::BuiltTile;
using roam::index::Leaf;
using roam::index::Node;
using roam::store::TileShape;

inline BuiltTile tile_of(std::span<const roam::Mesh> meshes, bool lossless = false) {
  const roam::index::Soup soup(meshes);
  std::vector<std::uint32_t> ids(soup.size());
  for (std::uint32_t i = 0; i < ids.size(); ++i) ids[i] = i;
  return build_tile(soup, ids, lossless);
}

inline std::vector<BuiltTile> tiles_of(std::span<const roam::Mesh> meshes, bool lossless) {
  const roam::index::Soup soup(meshes);
  const auto parts = roam::index::partition(soup, lossless, [](double) {});
  std::vector<BuiltTile> tiles;
  for (const auto& run : parts.tiles) {
    std::vector<std::uint32_t> ids(parts.order.begin() + run.begin, parts.order.begin() + run.end);
    std::sort(ids.begin(), ids.end());
    tiles.push_back(build_tile(soup, ids, lossless));
  }
  return tiles;
}

/// What decoding a tile that was encoded must give.
inline std::vector<std::byte> memory_of(const BuiltTile& tile) {
  const TileShape shape = roam::store::shape_of(tile);
  std::vector<std::byte> bytes(shape.bytes());
  std::byte* at = bytes.data();
  std::memcpy(at, tile.nodes.data(), tile.nodes.size() * sizeof(Block));
  at += tile.nodes.size() * sizeof(Block);
  std::uint32_t first = 0;
  for (Leaf leaf : tile.leaves) {
    leaf.ids = first;
    leaf.id_bytes = 0;
    first += leaf.triangle_count;
    std::memcpy(at, &leaf, sizeof(leaf));
    at += sizeof(leaf);
  }
  if (shape.fine) std::memcpy(at, tile.fine_leaves.data(), tile.fine_leaves.size() * sizeof(roam::index::FineLeaf));
  return bytes;
}

/// Memory for any tile, between bytes that nobody may write.
class Room {
 public:
  std::span<std::byte> tile(const TileShape& shape) {
    std::memset(blocks_.get(), guard_bytes, sizeof(Block));
    auto* begin = reinterpret_cast<std::byte*>(blocks_.get() + 1);
    std::memset(begin + shape.bytes(), guard_bytes, guard_count * sizeof(Block));
    return {begin, shape.bytes()};
  }
  [[nodiscard]] bool kept_inside(std::size_t bytes) const {
    const auto* all = reinterpret_cast<const unsigned char*>(blocks_.get());
    const auto guarded = [](unsigned char c) { return c == guard_bytes; };
    const auto* end = all + sizeof(Block) + bytes;
    return std::all_of(all, all + sizeof(Block), guarded) &&
           std::all_of(end, end + guard_count * sizeof(Block), guarded);
  }

 private:
  static constexpr unsigned char guard_bytes = 0xa5;
  static constexpr std::size_t block_count = roam::store::tile_bytes / sizeof(Block), guard_count = 16;
  std::unique_ptr<Block[]> blocks_ = std::make_unique<Block[]>(1 + block_count + guard_count);
};

/// What could lead a traversal out of a tile, or empty: every node and leaf is reached once, none is too deep.
inline std::string danger_of(std::span<const std::byte> bytes, const TileShape& shape) {
  const auto* nodes = reinterpret_cast<const Node*>(bytes.data());
  const auto* leaves = reinterpret_cast<const Leaf*>(nodes + shape.nodes);
  std::vector<int> seen_nodes(shape.nodes), seen_leaves(shape.leaves);
  struct Open {
    std::uint32_t node;
    int depth;
  };
  std::vector<Open> open{{0, 0}};
  while (!open.empty()) {
    const auto [at, depth] = open.back();
    open.pop_back();
    if (depth > roam::index::max_depth) return "too deep";
    if (seen_nodes[at]++ > 0) return "a node is reached twice";
    const Node& n = nodes[at];
    if (n.child_count < 1 || n.child_count > roam::index::node_width || n.inner_count > n.child_count) return "counts";
    for (int k = 0; k < 3; ++k) {
      if (n.shift[k] > 16) return "shift";
    }
    for (std::uint32_t c = 0; c < n.child_count; ++c) {
      const bool inner = c < n.inner_count;
      const std::uint32_t child = inner ? n.first_node + c : n.first_leaf + c - n.inner_count;
      if (child >= (inner ? shape.nodes : shape.leaves)) return "a child out of range";
      if (inner) {
        open.push_back({child, depth + 1});
      } else if (seen_leaves[child]++ > 0) {
        return "a leaf is reached twice";
      }
    }
  }
  std::uint32_t triangles = 0;
  for (std::uint32_t i = 0; i < shape.leaves; ++i) {
    if (seen_leaves[i] == 0) return "a leaf is not reached";
    if (leaves[i].triangle_count < 1 || leaves[i].triangle_count > roam::index::node_width)
      return "triangles of a leaf";
    if (leaves[i].ids != triangles || leaves[i].id_bytes != 0) return "ids of a leaf";
    triangles += leaves[i].triangle_count;
  }
  return triangles == shape.triangles ? "" : "triangles of the tile";
}

/// A coded tile taken apart, so that what is behind the compression can be damaged.
struct Unpacked {
  std::array<std::uint64_t, 8> numbers{};
  std::vector<std::byte> streams;
};

inline Unpacked unpack(std::span<const std::byte> coded) {
  Unpacked u;
  for (std::uint64_t& n : u.numbers) {
    if (!roam::store::read_number(coded, 28, n)) return {};
  }
  u.streams.resize(ZSTD_getFrameContentSize(coded.data(), coded.size()));
  u.streams.resize(ZSTD_decompress(u.streams.data(), u.streams.size(), coded.data(), coded.size()));
  return u;
}

inline std::vector<std::byte> pack(const Unpacked& u) {
  std::vector<std::byte> coded;
  for (const std::uint64_t n : u.numbers) roam::store::append_number(coded, n);
  roam::store::append_frame(coded, {&u.streams, 1});
  return coded;
}

}  // namespace store_codec
