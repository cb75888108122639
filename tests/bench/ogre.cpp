// What OGRE loads for its row of the paper's tables is what the command has laid out.

#include <gtest/gtest.h>

#include <cmath>

#include "bench/paper_movers.h"
#include "program.h"
#include "roam/error.h"

namespace roam::bench {
namespace {

/// Triangles of neighbours on a wavy line.
Mesh strip(std::uint32_t vertices) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < vertices; ++i) mesh.vertices.push_back({0.01 * i, std::sin(i), 3.1});
  for (std::uint32_t i = 0; i + 2 < vertices; ++i) mesh.triangles.push_back({i + 1, i, i + 2});
  return mesh;
}

TEST(BenchOgre, LoadsTheTrianglesThatWereWrittenShiftedAndAsFloats) {
  // The second needs indices of 32 bits, the others have 16.
  const std::vector<Mesh> written{strip(3), strip(70'000), strip(500)};
  const TestFolder folder;
  PaperScene scene;
  scene.tiles = folder.file("");
  scene.tile_count = written.size();
  {
    const auto write = ogre_tile_writer(scene.tiles);
    for (const Mesh& mesh : written) write(mesh);
  }
  std::vector<FloatMesh> read;
  read_ogre_tiles(scene, [&](FloatMesh tile) { read.push_back(std::move(tile)); });
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t tile = 0; tile < read.size(); ++tile) {
    FloatMesh expected;
    for (const Vec3& v : written[tile].vertices) {
      for (int k = 0; k < 3; ++k) expected.vertices.push_back(static_cast<float>(v[k] + paper_shift[k]));
    }
    for (const auto& t : written[tile].triangles) expected.indices.insert(expected.indices.end(), t.begin(), t.end());
    EXPECT_EQ(read[tile].vertices, expected.vertices) << tile;
    EXPECT_EQ(read[tile].indices, expected.indices) << tile;
  }
}

TEST(BenchOgre, SaysWhatItCannotWrite) {
  const auto write = ogre_tile_writer("/no/such/folder");
  EXPECT_THROW(write(strip(3)), Error);
}

}  // namespace
}  // namespace roam::bench
