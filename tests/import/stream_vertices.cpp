// Vertices that do not fit the memory come back as they were, in any order.

#include <gtest/gtest.h>

#include <random>

#include "import/reader/paged_vertices.h"

namespace roam::test {
namespace {

using reader::PagedVertices;

/// A place that tells the vertex and the list.
Vec3 place(std::uint64_t i, double list) { return {static_cast<double>(i), list, -0.5 * static_cast<double>(i)}; }

/// Vertices of which a sixth fits.
constexpr std::uint64_t count = 100 * PagedVertices::block_size + 17;
constexpr std::uint64_t memory = 16 * PagedVertices::block_size * sizeof(Vec3);

void fill(PagedVertices& vertices, double list) {
  for (std::uint64_t i = 0; i < count; ++i) vertices.add(place(i, list));
}

std::uint64_t wrong_at_random(PagedVertices& vertices, double list) {
  std::mt19937_64 random(1);
  std::uint64_t wrong = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::uint64_t at = random() % vertices.size();
    wrong += vertices[at] != place(at, list);
  }
  return wrong;
}

TEST(ImportStreamVertices, ComeBackInOrderAndAtRandom) {
  PagedVertices vertices(memory);
  fill(vertices, 1.0);
  ASSERT_EQ(vertices.size(), count);
  std::uint64_t wrong = 0;
  for (std::uint64_t i = 0; i < count; ++i) wrong += vertices[i] != place(i, 1.0);
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(wrong_at_random(vertices, 1.0), 0u);
}

TEST(ImportStreamVertices, GrowWhileTheyAreRead) {
  PagedVertices vertices(memory);
  std::uint64_t wrong = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    vertices.add(place(i, 2.0));
    const std::uint64_t at = i * 7919 % (i + 1);
    if (i % 5 == 0) wrong += vertices[at] != place(at, 2.0);
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(wrong_at_random(vertices, 2.0), 0u);
}

TEST(ImportStreamVertices, OfTheNextObjectAreNotThoseOfTheLast) {
  PagedVertices vertices(memory);
  for (const double list : {1.0, 2.0, 3.0}) {
    fill(vertices, list);
    EXPECT_EQ(wrong_at_random(vertices, list), 0u);
    vertices.clear();
    EXPECT_EQ(vertices.size(), 0u);
  }
}

}  // namespace
}  // namespace roam::test
