// Part files: what they keep, and damaged ones.
#include <gtest/gtest.h>

#include "packed_part.h"
#include "roam/error.h"
#include "store/part.h"
#include "store_files_made.h"

namespace {

using namespace roam;
using namespace roam::store;

using made::some_part;

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

TEST(PartFile, IsRefusedWhereItEndsEarly) {
  const std::vector<std::byte> good = encode_part(some_part());
  for (std::size_t size = 0; size < good.size(); size += 7) {
    EXPECT_THROW((void)decode_part(std::span(good).first(size), "p"), Error);
  }
}

}  // namespace
