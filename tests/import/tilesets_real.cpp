// Real 3D Tiles, whole and damaged.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "import_files.h"
#include "roam/import.h"

namespace roam::test {
namespace {

namespace fs = std::filesystem;

TEST(ImportTilesets, GiveTheTrianglesOfTheSameTilesAsOsgb) {
  ROAM_NEEDS_TEST_DATA();
  const ImportedScene osgb = import_scene(test_data() / "pit_osgb");
  const ImportedScene tiles = import_scene(test_data() / "pit_3dtiles/tileset.json", {.up = UpAxis::y});
  EXPECT_EQ(tiles.report.missing_pages, 0u);
  EXPECT_EQ(tiles.report.files, 221u);
  // The origin in metadata.xml.
  const Vec3 origin(54, -212, 0);
  const auto rounded = [](const ImportedScene& scene, const Vec3& moved) {
    std::vector<std::array<float, 9>> all;
    for (const Triangle& t : triangles_of(scene)) {
      std::array<float, 9> numbers{};
      for (std::size_t i = 0; i < 9; ++i)
        numbers[i] = static_cast<float>(t[i / 3][static_cast<int>(i % 3)] + moved[static_cast<int>(i % 3)]);
      all.push_back(numbers);
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  const auto wanted = rounded(osgb, Vec3(0.0)), got = rounded(tiles, 0.0 - origin);
  ASSERT_EQ(got.size(), 177'950u);
  ASSERT_EQ(wanted.size(), got.size());
  // OSGB files hold floats, so each coordinate is rounded once more. Neighbours may change places where they are equal.
  std::size_t differing = 0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    for (std::size_t k = 0; k < 9; ++k) {
      if (std::abs(got[i][k] - wanted[i][k]) > 1e-4f) {
        ++differing;
        break;
      }
    }
  }
  EXPECT_LT(differing, got.size() / 100);
}

TEST(ImportTilesets, ReadOrRefuseDamagedOnes) {
  ROAM_NEEDS_TEST_DATA();
  for (const auto& entry : fs::recursive_directory_iterator(test_data() / "bad/3dtiles")) {
    if (!entry.is_regular_file()) continue;
    const std::string error = import_error(entry.path());
    EXPECT_FALSE(contains(error, "crash")) << error;
    EXPECT_FALSE(contains(error, "broken, or not the roam-reader")) << error;
  }
  EXPECT_EQ(import_error(test_data() / "bad/3dtiles/TilesetGzipped/tileset.json"), "");
}

}  // namespace
}  // namespace roam::test
