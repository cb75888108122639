// The scenes of the folder of test data, as they are to be seen.

#include <string>
#include <vector>

#include "shown_scene.h"

namespace roam::test {
namespace {

namespace fs = std::filesystem;

/// Rounding in a cell of 256 m, in metres; scenes in inches have larger numbers.
constexpr double tolerance = 4e-5;

class ImportDisplayRealScenes : public testing::TestWithParam<const char*> {};

TEST_P(ImportDisplayRealScenes, AreShownAsTheyAreWalkedOn) {
  ROAM_NEEDS_TEST_DATA();
  const fs::path file = test_data() / GetParam();
  // Some keep their images beside the folder of the file.
  const ImportOptions options{.allow = {test_data()}};
  const Shown shown = show({file}, options);
  const ImportedScene scene = import_scene(file, options);
  EXPECT_EQ(not_shown(scene, shown, tolerance), 0u);
  EXPECT_EQ(shown.report.import.notes, scene.report.notes);
  EXPECT_EQ(shown.report.import.files, scene.report.files);
  EXPECT_FALSE(shown.report.paged);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ImportDisplayRealScenes,
                         testing::Values("underground/subt_tunnel_practice_1.ive",
                                         "underground/subt_tiles/tunnel_tile_1/meshes/tunnel_tile_1.dae",
                                         "underground/pittsburgh_mine.dae", "formats/pittsburgh_mine.osg",
                                         "formats/pittsburgh_mine.flt", "formats/pittsburgh_mine.stl",
                                         "formats/pittsburgh_mine.ply", "recast/dungeon.obj", "recast/undulating.obj",
                                         "building/small_house.glb", "building/willowgarage_visual.dae",
                                         "building/cpr_obstacle_world.stl", "scan/icl_nuim_living_room_kt2.ply",
                                         "city/delft.obj", "contextcapture_tiles/Tile_+010_+005_L22_000000t6.osgb",
                                         "bim/Duplex_A_20110907.ifc"));

TEST(ImportDisplayRealScenes, HaveTheTexturesOfPhotogrammetry) {
  ROAM_NEEDS_TEST_DATA();
  const Shown shown = show({test_data() / "contextcapture_tiles/Tile_+010_+005_L22_000000t6.osgb"});
  EXPECT_EQ(shown.report.textures, 1u);
  for (const ShownTriangle& triangle : shown.triangles) {
    ASSERT_NE(triangle.image, nullptr);
    EXPECT_EQ(triangle.colours[0], (Colour{255, 255, 255, 255}));
  }
}

TEST(ImportDisplayRealScenes, PageWhatIsPaged) {
  ROAM_NEEDS_TEST_DATA();
  const Shown shown = show({test_data() / "pit_osgb"});
  const Box box = bounds_of(import_scene(test_data() / "pit_osgb"));
  EXPECT_TRUE(shown.report.paged);
  EXPECT_TRUE(shown.triangles.empty());
  // The roots are coarse, so that their bounds are about those of the finest level.
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(shown.report.bounds.lower[k], box.lower[k], 5.0);
    EXPECT_NEAR(shown.report.bounds.upper[k], box.upper[k], 5.0);
  }
}

TEST(ImportDisplayRealScenes, ThatAreBrokenAreRefusedOrShownAsTheyAreWalkedOn) {
  ROAM_NEEDS_TEST_DATA();
  std::size_t refused = 0, good = 0;
  for (const auto& entry : fs::recursive_directory_iterator(test_data() / "bad")) {
    if (!entry.is_regular_file()) continue;
    const std::string name = entry.path().filename().string();
    // Their reader reads beyond its data: what comes differs from run to run.
    const bool random = name.starts_with("crash-") || name == "box_nested_animation_4286.dae";
    try {
      const Finest shown = show_finest({entry.path()});
      // Where all pages are missing, only the reading as a whole fails.
      const bool nothing = shown.report.paged && shown.triangles.empty() && !import_error(entry.path()).empty();
      if (nothing) {
        EXPECT_GT(shown.missing, 0u) << entry.path();
      } else if (!random) {
        EXPECT_EQ(not_shown(import_scene(entry.path()), shown, tolerance), 0u) << entry.path();
      }
      ++good;
    } catch (const Error& error) {
      if (!random) {
        EXPECT_EQ(error.what(), import_error(entry.path())) << entry.path();
      }
      ++refused;
    }
  }
  EXPECT_GT(refused, 100u);
  EXPECT_GT(good, 10u);
}

}  // namespace
}  // namespace roam::test
