// Pages of the index: what is encoded comes back, and bytes that are no page are refused.
#include "store/page.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <random>

#include "index/binary_tree.h"

namespace {

using namespace roam;
using namespace roam::store;

constexpr std::uint64_t pack_bytes = 1 << 30;

std::vector<TileEntry> some_tiles(std::size_t count, double spread, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-spread, spread), side(0.0, 64.0);
  std::vector<TileEntry> tiles(count);
  for (std::size_t i = 0; i < count; ++i) {
    TileEntry& t = tiles[i];
    for (int k = 0; k < 3; ++k) {
      t.lower[k] = place(random);
      t.upper[k] = t.lower[k] + side(random);
      t.origin[k] = std::floor(t.lower[k]);
    }
    t.step = 0x1p-10F;
    t.error = t.fine_error = 0.5e-3F;
    t.triangles = 1 + random() % 16384;
    t.leaves = static_cast<std::uint16_t>(1 + std::min<std::uint32_t>(t.triangles - 1, random() % 1500));
    t.nodes = static_cast<std::uint16_t>(1 + random() % std::min<std::uint32_t>(t.leaves, 100));
    t.offset = random() % (pack_bytes / 2);
    t.bytes = 1 + random() % 100'000;
    t.number_bytes = static_cast<std::uint32_t>(random() % (1 + most_number_bytes(t.triangles)));
    t.hash = i;
    for (auto& m : t.mask) m = random();
  }
  return tiles;
}

/// Aligned as PageView asks.
struct Copy {
  explicit Copy(std::span<const std::byte> bytes)
      : memory(std::make_unique<index::Block[]>(bytes.size() / sizeof(index::Block) + 1)), size(bytes.size()) {
    std::memcpy(memory.get(), bytes.data(), bytes.size());
  }
  [[nodiscard]] std::span<std::byte> bytes() const { return {reinterpret_cast<std::byte*>(memory.get()), size}; }
  std::unique_ptr<index::Block[]> memory;
  std::size_t size;
};

TEST(Page, HoldsEveryTileOnceWhereItsTreeSays) {
  for (const std::size_t count : {1, 2, 16, 17, 200, 1024}) {
    for (const double spread : {0.0, 100.0, 1e5, 9e8}) {
      const auto tiles = some_tiles(count, spread, 7);
      const EncodedPage page = encode_page(tiles);
      const Copy copy(page.bytes);
      PageView view;
      ASSERT_STREQ(view_page(copy.bytes(), pack_bytes, view), nullptr) << count << ' ' << spread;
      ASSERT_EQ(view.tiles.size(), count);
      std::vector<int> seen(count);
      for (std::size_t i = 0; i < count; ++i) {
        ++seen[page.order[i]];
        EXPECT_EQ(std::memcmp(&view.tiles[i], &tiles[page.order[i]], sizeof(TileEntry)), 0);
      }
      EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(count));
    }
  }
}

TEST(Page, IsTheSameForTheSameTiles) {
  const auto tiles = some_tiles(300, 500.0, 3);
  EXPECT_EQ(encode_page(tiles).bytes, encode_page(tiles).bytes);
}

TEST(Page, RefusesEntriesThatNoTileHas) {
  const auto refused = [](const std::function<void(TileEntry&)>& spoil) {
    auto tiles = some_tiles(20, 100.0, 5);
    const EncodedPage page = encode_page(tiles);
    const Copy copy(page.bytes);
    const std::size_t at = page.bytes.size() - 3 * sizeof(TileEntry);
    TileEntry entry;
    std::memcpy(&entry, copy.bytes().data() + at, sizeof entry);
    spoil(entry);
    std::memcpy(copy.bytes().data() + at, &entry, sizeof entry);
    PageView view;
    return view_page(copy.bytes(), pack_bytes, view) != nullptr;
  };
  EXPECT_FALSE(refused([](TileEntry& t) { t.hash ^= 1; })) << "the spoiling itself is not what is refused";
  EXPECT_TRUE(refused([](TileEntry& t) { t.triangles = 0; }));
  EXPECT_TRUE(refused([](TileEntry& t) { t.triangles = 16385; }));
  EXPECT_TRUE(refused([](TileEntry& t) { t.nodes = 0; }));
  EXPECT_TRUE(refused([](TileEntry& t) { t.leaves = 0; }));
  EXPECT_TRUE(refused([](TileEntry& t) { t.leaves = 65535; }));
  EXPECT_TRUE(refused([](TileEntry& t) { t.fine = 2; }));
  EXPECT_TRUE(refused([](TileEntry& t) { t.step = 0.3F; }));
  EXPECT_TRUE(refused([](TileEntry& t) { t.step = -0x1p-10F; }));
  EXPECT_TRUE(refused([](TileEntry& t) { t.error = std::numeric_limits<float>::quiet_NaN(); }));
  EXPECT_TRUE(refused([](TileEntry& t) { t.error = 1.0F; }));
  EXPECT_TRUE(refused([](TileEntry& t) { t.origin[1] = std::numeric_limits<double>::infinity(); }));
  EXPECT_TRUE(refused([](TileEntry& t) { t.lower[0] = t.upper[0] + 1.0; }));
  EXPECT_TRUE(refused([](TileEntry& t) { t.upper[2] += 1e6; })) << "then it lies outside its node";
  EXPECT_TRUE(refused([](TileEntry& t) { t.offset = pack_bytes; }));
  EXPECT_TRUE(refused([](TileEntry& t) { t.offset = ~std::uint64_t{0}; }));
  EXPECT_TRUE(refused([](TileEntry& t) { t.bytes = 0; }));
}

TEST(Page, RefusesAnythingWhereZerosBelong) {
  const std::vector<TileEntry> tiles = some_tiles(100, 300.0, 1);
  const std::vector<std::byte> bytes = encode_page(tiles).bytes;
  std::uint32_t nodes = 0;
  std::memcpy(&nodes, bytes.data() + 12, sizeof nodes);
  ASSERT_GT(nodes, 1U);
  const auto refused = [&](std::size_t at) {
    const Copy copy(bytes);
    copy.bytes()[at] = std::byte{1};
    PageView view;
    return view_page(copy.bytes(), pack_bytes, view) != nullptr;
  };
  for (std::size_t at = 48; at < 128; ++at) EXPECT_TRUE(refused(at)) << at;
  for (std::size_t node = 1; node <= nodes; ++node) {
    for (std::size_t at = 121; at < 128; ++at) EXPECT_TRUE(refused(128 * node + at)) << node << " " << at;
  }
}

TEST(Page, WhateverIsTakenForOneLeadsNobodyAstray) {
  const EncodedPage page = encode_page(some_tiles(150, 300.0, 9));
  std::mt19937 random(11);
  int taken = 0;
  for (int i = 0; i < 60'000; ++i) {
    const Copy copy(page.bytes);
    // Mostly in header and nodes, which lead a traversal.
    const std::size_t nodes_end = page.bytes.size() - 150 * sizeof(TileEntry);
    for (unsigned n = 0; n < 1 + random() % 3; ++n) {
      copy.bytes()[random() % (random() % 4 == 0 ? page.bytes.size() : nodes_end)] ^= std::byte(1U << random() % 8);
    }
    PageView view;
    if (view_page(copy.bytes(), pack_bytes, view) != nullptr) continue;
    ++taken;
    std::vector<int> tiles(view.tiles.size());
    std::size_t visited = 0;
    const std::function<void(std::uint32_t, int)> visit = [&](std::uint32_t number, int depth) {
      ASSERT_LT(number, view.nodes.size());
      ASSERT_LT(depth, index::max_depth);
      ASSERT_LE(++visited, view.nodes.size());
      const index::Node& node = view.nodes[number];
      for (std::uint32_t c = 0; c < node.child_count; ++c) {
        if (c < node.inner_count) {
          visit(node.first_node + c, depth + 1);
        } else {
          ASSERT_LT(node.first_leaf + c - node.inner_count, tiles.size());
          ++tiles[node.first_leaf + c - node.inner_count];
        }
      }
    };
    visit(0, 0);
    for (const int count : tiles) ASSERT_EQ(count, 1);
  }
  EXPECT_GT(taken, 0) << "flips in what only the checksum guards are taken";
  for (std::size_t size = 0; size < page.bytes.size(); size += 41) {
    const Copy copy(std::span(page.bytes).first(size));
    PageView view;
    EXPECT_NE(view_page(copy.bytes(), pack_bytes, view), nullptr);
  }
}

}  // namespace
