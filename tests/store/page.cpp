// Pages of the index: what is encoded comes back, and bytes that are no page are refused.
#include "store/page.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

#include "store_files_made.h"

namespace {

using namespace roam;
using namespace roam::store;

using made::AlignedCopy;
using made::pack_bytes;
using made::some_tiles;

TEST(Page, HoldsEveryTileOnceWhereItsTreeSays) {
  for (const std::size_t count : {1, 2, 16, 17, 200, 1024}) {
    for (const double spread : {0.0, 100.0, 1e5, 9e8}) {
      const auto tiles = some_tiles(count, spread, 7);
      const EncodedPage page = encode_page(tiles);
      const AlignedCopy copy(page.bytes);
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
    const AlignedCopy copy(page.bytes);
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
    const AlignedCopy copy(bytes);
    copy.bytes()[at] = std::byte{1};
    PageView view;
    return view_page(copy.bytes(), pack_bytes, view) != nullptr;
  };
  for (std::size_t at = 48; at < 128; ++at) EXPECT_TRUE(refused(at)) << at;
  for (std::size_t node = 1; node <= nodes; ++node) {
    for (std::size_t at = 121; at < 128; ++at) EXPECT_TRUE(refused(128 * node + at)) << node << " " << at;
  }
}

TEST(Page, IsRefusedWhereItEndsEarly) {
  const EncodedPage page = encode_page(some_tiles(150, 300.0, 9));
  for (std::size_t size = 0; size < page.bytes.size(); size += 41) {
    const AlignedCopy copy(std::span(page.bytes).first(size));
    PageView view;
    EXPECT_NE(view_page(copy.bytes(), pack_bytes, view), nullptr);
  }
}

}  // namespace
