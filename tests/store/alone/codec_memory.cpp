// Decoding asks nobody for memory, whatever it is given.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>

#include "clutter.h"
#include "roam/generate.h"
#include "tiles_made.h"

// The sanitizers bring allocators of their own.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {
std::atomic<std::size_t> allocations{0};
}

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  ++allocations;
  return __libc_realloc(memory, size);
}
}

namespace {

using namespace store_codec;

TEST(StoreCodecMemory, DecodesWithoutAllocating) {
  clutter::Random random(1);
  Room room;
  roam::store::TileDecoder decoder;  // before anything is counted, and never decoded with before
  std::vector<BuiltTile> tiles = tiles_of(collect(roam::generate::gallery({.triangles = 60000})), false);
  std::vector<std::vector<std::byte>> coded;
  for (BuiltTile& tile : tiles) coded.push_back(roam::store::encode_tile(tile));
  const std::size_t before = allocations;
  ASSERT_GT(before, tiles.size()) << "allocations are not counted";
  std::size_t decoded = 0, refused = 0;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const TileShape shape = roam::store::shape_of(tiles[i]);
    decoded += decoder.decode(coded[i], shape, room.tile(shape)) == nullptr ? 1 : 0;
    for (int n = 0; n < 50; ++n) {
      coded[i][random.engine() % coded[i].size()] = std::byte(random.engine() & 255U);
      refused += decoder.decode(coded[i], shape, room.tile(shape)) != nullptr ? 1 : 0;
    }
  }
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(decoded, tiles.size());
  EXPECT_GT(refused, tiles.size());
}

}  // namespace

#endif
