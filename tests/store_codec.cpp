// A tile goes to bytes and comes back bit for bit.

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <new>

#include "clutter.h"
#include "index/partition.h"
#include "index/tile_builder.h"
#include "store/codec/tile_codec.h"

namespace {

using roam::Mesh;
using roam::index::Block;
using roam::index::BuiltTile;
using roam::store::SourceNumber;
using roam::store::TileDecoder;
using roam::store::TileShape;

std::vector<BuiltTile> tiles_of(const std::vector<Mesh>& meshes, bool lossless) {
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

/// What a decoder must give for a tile.
std::vector<std::byte> memory_of(const BuiltTile& tile) {
  const TileShape shape = roam::store::shape_of(tile);
  std::vector<std::byte> bytes(shape.bytes());
  std::byte* at = bytes.data();
  std::memcpy(at, tile.nodes.data(), tile.nodes.size() * sizeof(Block));
  at += tile.nodes.size() * sizeof(Block);
  std::uint32_t first = 0;
  for (roam::index::Leaf leaf : tile.leaves) {
    leaf.ids = first;
    leaf.id_bytes = 0;
    first += leaf.triangle_count;
    std::memcpy(at, &leaf, sizeof(leaf));
    at += sizeof(leaf);
  }
  if (shape.fine) std::memcpy(at, tile.fine_leaves.data(), tile.fine_leaves.size() * sizeof(roam::index::FineLeaf));
  return bytes;
}

void expect_round_trip(const std::vector<Mesh>& meshes, bool lossless) {
  TileDecoder decoder;
  const auto out = std::make_unique<Block[]>(roam::store::kTileBytes / sizeof(Block));
  for (BuiltTile& tile : tiles_of(meshes, lossless)) {
    const TileShape shape = roam::store::shape_of(tile);
    if (shape.bytes() > roam::store::kTileBytes) continue;
    const auto coded = roam::store::encode_tile(tile);
    const char* why = decoder.decode(coded, shape, {reinterpret_cast<std::byte*>(out.get()), shape.bytes()});
    ASSERT_EQ(why, nullptr) << why;
    ASSERT_EQ(std::memcmp(out.get(), memory_of(tile).data(), shape.bytes()), 0);
  }
}

TEST(StoreCodec, BringsEveryTileBack) {
  clutter::Random random(7);
  const std::vector<Mesh> meshes{clutter::make(random, {20000, 30.0, 1e-3, 10.0, {10.0, 20.0, 30.0}})};
  expect_round_trip(meshes, false);
  expect_round_trip(meshes, true);
}

}  // namespace
