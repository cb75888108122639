// Part files: what they keep, and damaged ones.
#include <gtest/gtest.h>

#include <random>

#include "packed_part.h"
#include "roam/error.h"
#include "store/part.h"

namespace {

using namespace roam;
using namespace roam::store;

PartFile some_part() {
  PartFile part;
  part.cell_bits = 42;
  std::mt19937_64 random(3);
  CurveKey key = 0;
  for (int i = 0; i < 1000; ++i) {
    key += CurveKey{1 + random() % 1000} << (random() % 20 + 42);
    part.cells.push_back({key, 1 + random() % 100});
    part.triangles += part.cells.back().triangles;
  }
  part.objects = {{0, "floor"}, {10, ""}, {11, "wall"}};
  return part;
}

TEST(PartFile, ComesBackAsItWas) {
  const PartFile part = some_part();
  const PartFile again = decode_part(encode_part(part), "p");
  EXPECT_EQ(again.triangles, part.triangles);
  EXPECT_EQ(again.cell_bits, part.cell_bits);
  ASSERT_EQ(again.cells.size(), part.cells.size());
  for (std::size_t i = 0; i < part.cells.size(); ++i) {
    EXPECT_TRUE(again.cells[i].key == part.cells[i].key);
    EXPECT_EQ(again.cells[i].triangles, part.cells[i].triangles);
  }
  EXPECT_EQ(again.object(0), "floor");
  EXPECT_EQ(again.object(9), "floor");
  EXPECT_EQ(again.object(10), "");
  EXPECT_EQ(again.object(1'000'000), "wall");
}

TEST(PartFile, SurvivesAnyBytes) {
  const std::vector<std::byte> good = encode_part(some_part());
  std::mt19937 random(5);
  for (std::size_t size = 0; size < good.size(); size += 7) {
    EXPECT_THROW((void)decode_part(std::span(good).first(size), "p"), Error);
  }
  for (int i = 0; i < 20'000; ++i) {
    std::vector<std::byte> bad = good;
    for (unsigned n = 0; n < 1 + random() % 3; ++n) bad[random() % bad.size()] ^= std::byte(1 + random() % 255);
    try {
      (void)decode_part(bad, "p");
    } catch (const Error&) {
    }
  }
}

}  // namespace
