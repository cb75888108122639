// Whatever a decoder is given: it writes nothing but its tile, and what it calls a tile is safe to walk.

#include <gtest/gtest.h>

#include <cmath>

#include "clutter.h"
#include "roam/error.h"
#include "roam/generate.h"
#include "tiles_made.h"

namespace {

using namespace store_codec;
using roam::Mesh;
using roam::Vec3;

struct Coded {
  TileShape shape;
  std::vector<std::byte> bytes;
};

Coded code(BuiltTile tile) { return {roam::store::shape_of(tile), roam::store::encode_tile(tile)}; }

/// Tiles of all kinds, small enough to be decoded often.
std::vector<Coded> samples() {
  std::vector<Coded> coded;
  clutter::Random random(2);
  for (const bool lossless : {false, true}) {
    const Mesh mesh = clutter::make(random, {200, 5.0, 0.05, 3.0, Vec3(1.0)});
    coded.push_back(code(tile_of({&mesh, 1}, lossless)));
    for (const auto& scene :
         {roam::generate::gallery({.triangles = 20000}), roam::generate::city({.triangles = 20000})}) {
      int taken = 0;
      for (BuiltTile& tile : tiles_of(collect(scene), lossless)) {
        const TileShape shape = roam::store::shape_of(tile);
        if (shape.triangles > 200 && shape.triangles < 2000 && taken++ < 2) coded.push_back(code(std::move(tile)));
      }
    }
  }
  return coded;
}

/// Bytes of a tile of which every bit is tried.
constexpr std::size_t small_size = 1000;

class StoreCodecDamage : public testing::Test {
 protected:
  /// Whether the bytes are taken for a tile; a failure where that is not safe.
  bool decodes(std::span<const std::byte> bytes, const TileShape& shape) {
    // A copy of its own, so that the address sanitizer sees each byte that is read beyond the end.
    const std::vector<std::byte> exact(bytes.begin(), bytes.end());
    const std::span<std::byte> out = room_.tile(shape);
    const char* why = decoder_.decode(exact, shape, out);
    EXPECT_TRUE(room_.kept_inside(shape.bytes()));
    if (why != nullptr) {
      EXPECT_STRNE(why, "");
      return false;
    }
    EXPECT_EQ(danger_of(out, shape), "");
    return true;
  }

  roam::store::TileDecoder decoder_;
  Room room_;
};

TEST_F(StoreCodecDamage, RefusesEveryTruncation) {
  for (const Coded& c : samples()) {
    ASSERT_TRUE(decodes(c.bytes, c.shape));
    for (std::size_t size = 0; size < c.bytes.size(); ++size) {
      ASSERT_FALSE(decodes({c.bytes.data(), size}, c.shape)) << size;
    }
    auto longer = c.bytes;
    longer.push_back(std::byte{0});
    ASSERT_FALSE(decodes(longer, c.shape));
    longer.insert(longer.end(), c.bytes.begin(), c.bytes.end());
    ASSERT_FALSE(decodes(longer, c.shape));
  }
}

TEST_F(StoreCodecDamage, IsSafeAfterEveryFlippedBit) {
  const Mesh one{"", {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.5}, {0.0, 1.0, 0.0}}, {{0, 1, 2}}};
  std::vector<Coded> all = samples();
  all.push_back(code(tile_of({&one, 1})));
  for (Coded& c : all) {
    if (c.bytes.size() > small_size) continue;
    for (std::size_t bit = 0; bit < 8 * c.bytes.size(); ++bit) {
      const auto mask = std::byte(1U << (bit % 8));
      c.bytes[bit / 8] ^= mask;
      (void)decodes(c.bytes, c.shape);
      c.bytes[bit / 8] ^= mask;
      if (HasFailure()) FAIL() << "bit " << bit;
    }
  }
}

TEST_F(StoreCodecDamage, RefusesATreeThatIsTooDeep) {
  // Each node has one inner child and, but for the last, no leaf.
  for (const std::uint32_t deep : {std::uint32_t{roam::index::max_depth}, std::uint32_t{roam::index::max_depth} + 1}) {
    const Mesh one{"", {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.5}, {0.0, 1.0, 0.0}}, {{0, 1, 2}}};
    Coded c = code(tile_of({&one, 1}));
    Unpacked u = unpack(c.bytes);
    u.streams.insert(u.streams.begin(), deep, std::byte{1});
    c.shape.nodes += deep;
    EXPECT_EQ(decodes(pack(u), c.shape), deep <= roam::index::max_depth) << deep;
  }
}

TEST_F(StoreCodecDamage, RefusesFramesThatTheLibraryWouldAllocateFor) {
  Coded c = samples()[0];
  const std::array bytes{std::byte{0x28}, std::byte{0xb5}, std::byte{0x2f}, std::byte{0xfd}};
  const auto magic = std::search(c.bytes.begin(), c.bytes.end(), bytes.begin(), bytes.end());
  ASSERT_NE(magic, c.bytes.end());
  for (const unsigned old : {0x25U, 0x26U, 0x27U}) {  // formats 0.5 to 0.7
    *magic = std::byte(old);
    EXPECT_FALSE(decodes(c.bytes, c.shape));
  }
}

TEST(StoreCodecNumbers, RefuseDamage) {
  clutter::Random random(9);
  std::vector<roam::store::SourceNumber> numbers(500);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = {i / 100, random.engine() % 1000};
  const auto coded = roam::store::encode_numbers(numbers);
  const auto decode = [&](std::span<const std::byte> bytes) {
    try {
      EXPECT_EQ(roam::store::decode_numbers(bytes, 500).size(), 500U);
      return true;
    } catch (const roam::Error&) {
      return false;
    }
  };
  ASSERT_TRUE(decode(coded));
  for (std::size_t size = 0; size < coded.size(); ++size) ASSERT_FALSE(decode({coded.data(), size}));
  for (int i = 0; i < 20000; ++i) {
    auto bytes = coded;
    for (int n = 0; n < 3; ++n) bytes[random.engine() % bytes.size()] = std::byte(random.engine() & 255U);
    (void)decode(bytes);
  }
}

}  // namespace
