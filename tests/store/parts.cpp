// What a part file may hold: as much as its size justifies, in order.
#include <gtest/gtest.h>

#include <algorithm>

#include "packed_part.h"
#include "roam/error.h"
#include "store/part.h"

namespace {

using namespace roam::store;
using packed_parts::number;
using packed_parts::packed_part;

/// Why a part of 100 triangles is refused; empty: it is not.
std::string refusal(std::uint64_t objects, const std::string& content, int window = 21) {
  try {
    (void)decode_part(packed_part(100, objects, 1, content + number(0) + number(100), window), "p");
  } catch (const roam::Error& error) {
    return error.what();
  }
  return "";
}
std::string object(std::uint64_t step, const std::string& name = "") {
  return number(step) + number(name.size()) + name;
}

TEST(PartFile, HasItsObjectsInOrderAmongItsTriangles) {
  EXPECT_EQ(refusal(0, ""), "");
  EXPECT_EQ(refusal(2, object(0) + object(99)), "");
  EXPECT_NE(refusal(2, object(0) + object(0)), "");
  EXPECT_NE(refusal(2, object(0) + object(100)), "");
  EXPECT_NE(refusal(1, object(100)), "");
  EXPECT_NE(refusal(2, object(50) + object(UINT64_MAX)), "");
  std::string many = object(0);
  for (int i = 1; i < 101; ++i) many += object(1);
  EXPECT_NE(refusal(101, many), "");
  EXPECT_NE(refusal(101, many).find("out of range"), std::string::npos) << "before it is unpacked";
}

TEST(PartFile, UnpacksToAsMuchAsItsSizeJustifies) {
  EXPECT_EQ(refusal(1, object(0, std::string(4000, 'a'))), "");
  EXPECT_NE(refusal(1, object(0, std::string(100'000, 'a'))), "");
  EXPECT_EQ(refusal(1, object(0, std::string(100'000, 'a')), 10), "");
  // Large contents have a small window, of which every kilobyte takes some bytes.
  std::string name(4'000'000, 'a');
  for (std::size_t i = 0; i < name.size(); ++i) name[i] = static_cast<char>('a' + i * i * 7919 % 1'000'003 % 26);
  EXPECT_NE(refusal(1, object(0, name), 21), "");
  EXPECT_EQ(refusal(1, object(0, name), 10), "");
}

TEST(PartFile, OfABuilderIsReadHoweverWellItPacks) {
  for (const std::uint64_t objects : {3u, 3'000u, 300'000u, 3'000'000u}) {
    PartFile part;
    part.triangles = 12 * objects;
    for (std::uint64_t i = 0; i < objects; ++i) part.objects.push_back({12 * i, ""});
    part.cells.push_back({0, part.triangles});
    EXPECT_EQ(decode_part(encode_part(part), "p").objects.size(), objects);
  }
}

TEST(PartFile, IsUnpackedNoFurtherThanNeeded) {
  PartFile part;
  part.triangles = 1'000'000;
  for (std::uint64_t i = 0; i < part.triangles; ++i) part.objects.push_back({i, ""});
  part.cells.push_back({0, part.triangles});
  const std::vector<std::byte> packed = encode_part(part);
  std::span<const std::byte> left(packed);
  std::uint64_t seen = 0;
  PartVisitor visitor;
  visitor.object = [&](std::uint64_t, std::string_view) { ++seen; };
  visitor.enough = [&] { return seen > 10; };
  const auto more = [&](std::span<std::byte> out) {
    const std::size_t size = std::min(out.size(), left.size());
    std::copy_n(left.begin(), size, out.begin());
    left = left.subspan(size);
    return size;
  };
  visit_part(more, packed.size(), "p", visitor);
  EXPECT_GT(seen, 10U);
  EXPECT_LT(seen, 100'000U);
}

}  // namespace
