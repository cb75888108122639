// The frame of a scene leads back to the coordinates of its file.
#include <gtest/gtest.h>

#include "import_files.h"

namespace roam::test {
namespace {

TEST(SceneFrame, LeadsBackToTheFile) {
  const TemporaryFolder folder;
  const auto file = folder.write("t.obj", "v 1 2 3\nv 5 7 11\nv 13 17 19\nf 1 2 3\n");
  const Vec3 corners[] = {{1, 2, 3}, {5, 7, 11}, {13, 17, 19}};
  for (const char* up : up_axis_names) {
    for (const char* unit : length_unit_names) {
      const ImportOptions options{.up = parse_up_axis(up), .unit = parse_length_unit(unit)};
      const Triangle read = triangles_of(import_scene(file, options)).at(0);
      const auto rows = frame_of(std::vector<std::filesystem::path>{file}, options)->to_file();
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
          const double back = rows[k][0] * read[i].x + rows[k][1] * read[i].y + rows[k][2] * read[i].z + rows[k][3];
          EXPECT_NEAR(back, corners[i][static_cast<int>(k)], 1e-12) << up << " " << unit;
        }
      }
    }
  }
}

TEST(SceneFrame, IsThatOfTheFormatWithoutOptions) {
  using Paths = std::vector<std::filesystem::path>;
  EXPECT_EQ(frame_of(Paths{"a.glb", "b.GLTF"}), (SceneFrame{.up = UpAxis::y}));
  EXPECT_EQ(frame_of(Paths{"a.obj", "Data"}), SceneFrame{});
  EXPECT_EQ(frame_of(Paths{"a.obj", "b.glb"}), std::nullopt);
  EXPECT_EQ(frame_of(Paths{"a.obj", "b.glb"}, {.up = UpAxis::x}), (SceneFrame{.up = UpAxis::x}));
}

}  // namespace
}  // namespace roam::test
