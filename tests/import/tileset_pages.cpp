// A tileset by its levels of detail: which tiles its pages have, and that together they are the tiles that stop bodies.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <string>
#include <vector>

#include "gltf_made.h"
#include "import_files.h"
#include "roam/error.h"
#include "shown_scene.h"

namespace roam::test {
namespace {

namespace fs = std::filesystem;
using Heights = std::set<double>;

constexpr float endless = std::numeric_limits<float>::max();

/// Writes tiles of heights 1, 2, ... and a tileset of them.
fs::path write_paged_scene(const TemporaryFolder& folder, const Json& root, int tiles,
                           const Json& asset = {{"version", "1.1"}}) {
  for (int i = 1; i <= tiles; ++i) {
    folder.write("tiles/" + std::to_string(i) + ".b3dm",
                 made_tile("b3dm", MadeGrid(1, static_cast<float>(i)).gltf().glb()));
  }
  return folder.write("tiles/tileset.json", made_tileset(root, asset));
}

/// A tile with bounds and an error.
Json tile(const std::string& uri, double error, const Json& children = Json::array(), const char* refine = "REPLACE") {
  Json node = made_node(uri, children, refine);
  node["geometricError"] = error;
  node["boundingVolume"] = {{"box", {0, 0, 0, 10, 0, 0, 0, 20, 0, 0, 0, 30}}};
  return node;
}

/// The heights of the triangles of a group, each once.
Heights heights_of(const DisplayPart& part, std::uint32_t group) {
  DisplayPart kept = part;
  std::erase_if(kept.geometries, [&](const DisplayGeometry& g) { return g.group != group; });
  Heights heights;
  for (const ShownTriangle& triangle : triangles_of(kept)) heights.insert(std::floor(triangle.corners[0].z + 1e-6));
  return heights;
}

/// The same of a tileset, all of which is in its page.
struct TilesetPaging : Paging {
  explicit TilesetPaging(const fs::path& tileset, const ImportOptions& options = {}) : Paging(tileset, options) {
    if (!shown.triangles.empty()) throw std::runtime_error("the tileset is not paged");
  }
};

TEST(ImportTilesetPages, ReplaceATileByAllItsChildrenAtOnce) {
  const TemporaryFolder folder;
  Json root = tile("1.b3dm", 4, {tile("2.b3dm", 0), tile("3.b3dm", 2, Json::array({tile("4.b3dm", 0)}))});
  root["transform"] = {3, 0, 0, 0, 0, 3, 0, 0, 0, 0, 3, 0, 100, 0, 0, 1};
  TilesetPaging paging(write_paged_scene(folder, root, 4), {.unit = LengthUnit::cm});
  EXPECT_EQ(paging.first.measure, DisplayMeasure::error);
  EXPECT_LT(glm::length(paging.first.center - Vec3(1, 0, 0)), 1e-6);
  EXPECT_LT(glm::length(paging.first.half - glm::vec3(0.3f, 0.6f, 0.9f)), 1e-6f);
  EXPECT_TRUE(paging.report.paged);
  EXPECT_NEAR(paging.report.bounds.upper.z, 0.9, 1e-6);

  ASSERT_EQ(paging.root.pages.size(), 1u);
  const DisplayPages& node = paging.root.pages[0];
  EXPECT_NEAR(node.error, 4 * 3 * 0.01, 1e-6);
  ASSERT_EQ(node.levels.size(), 2u);
  EXPECT_EQ(node.levels[0].from, 0.0f);
  EXPECT_EQ(node.levels[0].to, 1.0f);
  EXPECT_EQ(node.levels[1].from, 1.0f);
  EXPECT_EQ(node.levels[1].to, endless);
  EXPECT_EQ(paging.root.triangles, 2u);
  EXPECT_EQ(paging.root.geometries.at(0).group, node.levels[0].group);

  const DisplayPart children = paging.page(node.levels[1]);
  EXPECT_EQ(children.triangles, 4u);
  ASSERT_EQ(children.pages.size(), 1u);
  EXPECT_NEAR(children.pages[0].error, 2 * 3 * 0.01, 1e-6);
  EXPECT_EQ(paging.page(children.pages[0].levels.at(1)).triangles, 2u);
}

TEST(ImportTilesetPages, AddTilesOneByOne) {
  const TemporaryFolder folder;
  TilesetPaging paging(write_paged_scene(folder, tile("1.b3dm", 4, {tile("2.b3dm", 0), tile("3.b3dm", 0)}, "ADD"), 3));
  ASSERT_EQ(paging.root.pages.size(), 3u);
  const DisplayPages& node = paging.root.pages[0];
  ASSERT_EQ(node.levels.size(), 2u);
  EXPECT_EQ(node.levels[0].to, endless);
  EXPECT_EQ(heights_of(paging.root, node.levels[0].group), Heights{1});
  EXPECT_EQ(node.levels[1].from, 1.0f);
  double height = 2;
  for (const std::size_t i : {1u, 2u}) {
    const DisplayPages& child = paging.root.pages[i];
    EXPECT_EQ(child.group, node.levels[1].group);
    EXPECT_EQ(heights_of(paging.page(child.levels.at(0)), 0), Heights{height++});
  }
}

TEST(ImportTilesetPages, PassThroughTilesWithoutContent) {
  const TemporaryFolder folder;
  // Below a tile that is replaced, at once: nothing else is there to be seen.
  const Json empty = tile("", 2, {tile("2.b3dm", 0), tile("", 1, Json::array({tile("3.b3dm", 0)}))});
  TilesetPaging replaced(write_paged_scene(folder, tile("1.b3dm", 4, Json::array({empty})), 3));
  EXPECT_EQ(heights_of(replaced.page(replaced.root.pages.at(0).levels.at(1)), 0), (Heights{2, 3}));
  // Else one by one, as near as their errors say.
  TilesetPaging alone(write_paged_scene(folder, tile("", 4, {tile("1.b3dm", 0), empty}), 3));
  EXPECT_EQ(alone.root.triangles, 0u);
  ASSERT_EQ(alone.root.pages.size(), 3u);
  EXPECT_EQ(alone.root.pages[0].error, 4.0f);
  EXPECT_EQ(heights_of(alone.page(alone.root.pages[1].levels.at(0)), 0), Heights{1});
  const DisplayPart second = alone.page(alone.root.pages[2].levels.at(0));
  ASSERT_EQ(second.pages.size(), 3u);
  EXPECT_EQ(second.pages[0].error, 2.0f);
}

/// An implicit quadtree of three levels in subtrees of two, all of whose tiles are there.
Json write_implicit(const TemporaryFolder& folder, bool inner_contents) {
  const Json everything{{"constant", 1}}, nothing{{"constant", 0}};
  folder.write("tiles/s/0.0.0.subtree", Json{{"tileAvailability", everything},
                                             {"contentAvailability", {inner_contents ? everything : nothing}},
                                             {"childSubtreeAvailability", everything}}
                                            .dump());
  float height = 1;
  for (int level = 0; level < 3; ++level) {
    for (int x = 0; x < 1 << level; ++x) {
      for (int y = 0; y < 1 << level; ++y) {
        const std::string place = std::to_string(level) + "." + std::to_string(x) + "." + std::to_string(y);
        folder.write("tiles/c/" + place + ".b3dm", made_tile("b3dm", MadeGrid(1, height++).gltf().glb()));
        if (level == 2) {
          folder.write("tiles/s/" + place + ".subtree", Json{{"tileAvailability", everything},
                                                             {"contentAvailability", {everything}},
                                                             {"childSubtreeAvailability", nothing}}
                                                            .dump());
        }
      }
    }
  }
  Json root = tile("c/{level}.{x}.{y}.b3dm", 8);
  root["implicitTiling"] = {{"subdivisionScheme", "QUADTREE"},
                            {"subtreeLevels", 2},
                            {"availableLevels", 3},
                            {"subtrees", {{"uri", "s/{level}.{x}.{y}.subtree"}}}};
  return root;
}

TEST(ImportTilesetPages, FollowImplicitTilingsFromSubtreeToSubtree) {
  const TemporaryFolder folder;
  TilesetPaging paging(write_paged_scene(folder, write_implicit(folder, true), 0));
  EXPECT_EQ(heights_of(paging.root, paging.root.pages.at(0).levels[0].group), Heights{1});
  const DisplayPart second = paging.page(paging.root.pages[0].levels.at(1));
  ASSERT_EQ(second.pages.size(), 4u);
  EXPECT_EQ(second.pages[0].error, 4.0f);
  EXPECT_EQ(second.pages[0].half, glm::vec3(5, 10, 30));
  EXPECT_EQ(second.pages[0].center, Vec3(-5, -10, 0));
  EXPECT_EQ(second.pages[3].center, Vec3(5, 10, 0));
  EXPECT_EQ(heights_of(paging.page(second.pages[0].levels.at(1)), 0), (Heights{6, 7, 10, 11}));
  const Finest all = show_finest({folder.path() / "tiles"});
  EXPECT_EQ(all.triangles.size(), 32u);
  EXPECT_EQ(not_shown(import_scene(folder.path() / "tiles"), all, 1e-5), 0u);
}

TEST(ImportTilesetPages, ReadASubtreeAnewForATilingOfOtherLength) {
  const TemporaryFolder folder;
  folder.write("tiles/bits", std::string(8, '\xff'));
  folder.write("tiles/s.json", Json{{"buffers", {{{"uri", "bits"}, {"byteLength", 8}}}},
                                    {"bufferViews", {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 1}}}},
                                    {"tileAvailability", {{"bitstream", 0}}},
                                    {"contentAvailability", {{{"constant", 0}}}},
                                    {"childSubtreeAvailability", {{"constant", 0}}}}
                                   .dump());
  const auto tiling = [](int levels) {
    Json root = tile("{level}.b3dm", 2);
    root["implicitTiling"] = {{"subdivisionScheme", "QUADTREE"},
                              {"subtreeLevels", levels},
                              {"availableLevels", levels},
                              {"subtrees", {{"uri", "s.json"}}}};
    return root;
  };
  TilesetPaging paging(write_paged_scene(folder, tile("1.b3dm", 4, {tiling(2), tiling(20)}), 1));
  const std::string error = paging.error(paging.root.pages.at(0).levels.at(1));
  EXPECT_NE(error.find("fewer bits"), std::string::npos) << error;
}

TEST(ImportTilesetPages, AreTheTrianglesThatStopBodies) {
  const TemporaryFolder folder;
  folder.write("tiles/deep/inner.json",
               made_tileset(tile("../2.b3dm", 2, {tile("../3.b3dm", 0), tile("../4.b3dm", 0)}, "ADD")));
  Json moved = tile("deep/inner.json", 2);
  moved["transform"] = {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 10, 20, 30, 1};
  Json elsewhere = moved;
  elsewhere["transform"][12] = 50;
  Json two = tile("", 0);
  two["contents"] = {{{"uri", "3.b3dm"}}, {{"uri", "4.b3dm"}}};
  int scenes = 0;
  for (const Json& root :
       {tile("1.b3dm", 4, {tile("2.b3dm", 1, Json::array({tile("3.b3dm", 0)})), tile("4.b3dm", 0)}),
        tile("1.b3dm", 4, {tile("2.b3dm", 1, Json::array({tile("3.b3dm", 0)})), tile("4.b3dm", 0)}, "ADD"),
        tile("1.b3dm", 4, {moved, tile("", 3, {tile("4.b3dm", 0), elsewhere})}), tile("deep/inner.json", 4), moved,
        tile("1.b3dm", 4, {two, moved}), tile("", 4, {two, tile("1.b3dm", 0)}), write_implicit(folder, true),
        write_implicit(folder, false)}) {
    for (const char* axis : {"Y", "Z"}) {
      const fs::path tileset = write_paged_scene(folder, root, 4, {{"version", "1.0"}, {"gltfUpAxis", axis}});
      for (const ImportOptions& options : {ImportOptions{}, ImportOptions{.up = UpAxis::y, .unit = LengthUnit::ft}}) {
        const Finest shown = show_finest({tileset}, options);
        EXPECT_TRUE(shown.report.paged);
        EXPECT_EQ(not_shown(import_scene(tileset, options), shown, 1e-4), 0u) << root.dump();
        EXPECT_EQ(shown.missing, 0u);
        ++scenes;
      }
    }
  }
  EXPECT_EQ(scenes, 36);
}

TEST(ImportTilesetPages, LieInTheFrameOfTheScene) {
  const TemporaryFolder folder;
  // Near 46.2 N, 8.1 E, by a region; the contents at its middle.
  constexpr double degree = 0.017453292519943295;
  const Json region = {{"region", {8.099 * degree, 46.199 * degree, 8.101 * degree, 46.201 * degree, 400, 600}}};
  const Vec3 place(4378305.2, 623131.0, 4581105.6);
  Json child = tile("2.b3dm", 0);
  child["boundingVolume"] = region;
  child["transform"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, place.x, place.y, place.z, 1};
  Json root = tile("", 100, Json::array({child}));
  root["boundingVolume"] = region;
  const fs::path tileset = write_paged_scene(folder, root, 2);
  TilesetPaging paging(tileset);
  ASSERT_TRUE(paging.report.import.georeference);
  EXPECT_EQ(paging.report.import.georeference->srs, "ENU:46.2,8.1");
  EXPECT_EQ(paging.report.import.notes, import_scene(tileset).report.notes);
  EXPECT_NEAR(paging.first.center.z, 500, 1);
  EXPECT_NEAR(paging.first.half.x, 77, 2);
  EXPECT_NEAR(paging.first.half.y, 111, 2);
  EXPECT_EQ(not_shown(import_scene(tileset), show_finest({tileset}), 1e-4), 0u);
}

TEST(ImportTilesetPages, KeepTheCoarserTileWhereAFinerOneIsMissing) {
  const TemporaryFolder folder;
  for (const char* content : {"", "b3dm", "version https://git-lfs.github.com/spec/v1\n"}) {
    const fs::path tileset = write_paged_scene(folder, tile("1.b3dm", 4, {tile("2.b3dm", 0), tile("3.b3dm", 0)}), 2);
    if (*content != '\0') folder.write("tiles/3.b3dm", content);
    TilesetPaging paging(tileset);
    EXPECT_TRUE(contains(paging.error(paging.root.pages.at(0).levels.at(1)), "tiles/3.b3dm: this tile is absent"));
    const Finest shown = show_finest({tileset});
    EXPECT_EQ(not_shown(import_scene(tileset), shown, 1e-5), 0u) << content;
    EXPECT_EQ(shown.missing, 1u);
  }
  // A missing tile with finer ones is passed through.
  const fs::path through = write_paged_scene(
      folder, tile("1.b3dm", 4, Json::array({tile("gone.b3dm", 1, Json::array({tile("2.b3dm", 0)}))})), 2);
  EXPECT_EQ(not_shown(import_scene(through), show_finest({through}), 1e-5), 0u);
  // Tiles that are added are missing one by one.
  const fs::path added =
      write_paged_scene(folder, tile("1.b3dm", 4, {tile("2.b3dm", 0), tile("gone.b3dm", 0)}, "ADD"), 2);
  const Finest shown = show_finest({added});
  EXPECT_EQ(shown.triangles.size(), 4u);
  EXPECT_EQ(shown.missing, 1u);
}

TEST(ImportTilesetPages, SayWhatIsDamagedInATile) {
  const TemporaryFolder folder;
  const fs::path tileset = write_paged_scene(folder, tile("1.b3dm", 4, {tile("2.b3dm", 0), tile("3.b3dm", 0)}), 2);
  MadeGltf broken = MadeGrid(1, 3).gltf();
  broken.add_mesh({{"attributes", {{"POSITION", 77}}}});
  broken.json["nodes"].push_back({{"mesh", 1}});
  broken.json["scenes"][0]["nodes"] = {0, 1};
  folder.write("tiles/3.b3dm", made_tile("b3dm", broken.glb()));
  const Finest shown = show_finest({tileset});
  EXPECT_EQ(not_shown(import_scene(tileset), shown, 1e-5), 0u);
  EXPECT_EQ(shown.missing, 1u);
  ASSERT_EQ(shown.notes.size(), 1u);
  EXPECT_TRUE(contains(shown.notes[0], "3.b3dm"));
}

TEST(ImportTilesetPages, LeaveOutPointsByName) {
  const TemporaryFolder folder;
  folder.write("tiles/trees.pnts", "pnts" + packed(std::vector<std::uint32_t>{1, 28, 0, 0, 0, 0}));
  const fs::path tileset = write_paged_scene(folder, tile("1.b3dm", 4, Json::array({tile("trees.pnts", 0)}), "ADD"), 1);
  const Finest shown = show_finest({tileset});
  EXPECT_EQ(shown.triangles.size(), 2u);
  EXPECT_EQ(shown.missing, 0u);
  ASSERT_EQ(shown.notes.size(), 1u);
  EXPECT_TRUE(contains(shown.notes[0], "trees.pnts: point clouds have no surface"));
}

TEST(ImportTilesetPages, AreNotMadeOfASingleTile) {
  const TemporaryFolder folder;
  const Shown shown = show({write_paged_scene(folder, tile("1.b3dm", 0), 1)});
  EXPECT_FALSE(shown.report.paged);
  EXPECT_EQ(shown.triangles.size(), 2u);
}

TEST(ImportTilesetPages, CostLittleWhenTheyAreHostile) {
  const TemporaryFolder folder;
  const auto begin = std::chrono::steady_clock::now();
  // A tileset in itself.
  const fs::path circle = write_paged_scene(folder, tile("1.b3dm", 4, Json::array({tile("tileset.json", 0)})), 1);
  EXPECT_EQ(not_shown(import_scene(circle), show_finest({circle}), 1e-5), 0u);
  const fs::path circle_alone = write_paged_scene(folder, tile("tileset.json", 4), 1);
  EXPECT_EQ(show_finest({circle_alone}).triangles.size(), 0u);
  // Tilesets in each other without end, each of them deep.
  Json deep = tile("next", 1);
  for (int k = 0; k < 900; ++k) deep = tile("", 1, Json::array({std::move(deep)}));
  const std::string text = made_tileset(deep);
  const std::size_t next = text.find("\"next\"");
  for (int i = 0; i < 200; ++i) {
    folder.write("tiles/" + std::to_string(i) + ".json",
                 text.substr(0, next) + "\"" + std::to_string(i + 1) + ".json\"" + text.substr(next + 6));
  }
  const Finest endless_chain =
      show_finest({write_paged_scene(folder, tile("1.b3dm", 4, Json::array({tile("0.json", 4)})), 1)});
  EXPECT_EQ(endless_chain.triangles.size(), 2u);
  EXPECT_GE(endless_chain.missing, 1u);
  // Addresses elsewhere.
  for (const char* uri : {"http://example.org/1.b3dm", "../../../../etc/passwd", "/etc/passwd", "data:,b3dm"}) {
    const fs::path elsewhere = write_paged_scene(folder, tile("1.b3dm", 4, {tile(uri, 0), tile("2.b3dm", 0)}), 2);
    const Finest shown = show_finest({elsewhere});
    EXPECT_EQ(shown.triangles.size(), 2u) << uri;
    EXPECT_EQ(shown.missing, 1u) << uri;
  }
  // Tiles without number, all of them empty.
  Json endless_tiles = write_implicit(folder, false);
  endless_tiles["implicitTiling"]["subtreeLevels"] = endless_tiles["implicitTiling"]["availableLevels"] = 20;
  folder.write("tiles/s/0.0.0.subtree", Json{{"tileAvailability", {{"constant", 1}}},
                                             {"contentAvailability", {{{"constant", 0}}}},
                                             {"childSubtreeAvailability", {{"constant", 0}}}}
                                            .dump());
  const fs::path many = write_paged_scene(folder, tile("1.b3dm", 4, Json::array({endless_tiles})), 1);
  TilesetPaging paging(many);
  EXPECT_NE(paging.error(paging.root.pages.at(0).levels.at(1)), "");
  // Wrong types everywhere.
  for (const Json& odd : {Json(1), Json("x"), Json(nullptr), Json::array({1, nullptr}), Json{{"uri", 7}}}) {
    for (const char* key : {"children", "content", "contents", "transform", "refine", "boundingVolume",
                            "implicitTiling", "extensions", "geometricError"}) {
      Json wrong = tile("1.b3dm", 4, {tile("2.b3dm", 0), tile("3.b3dm", 0)});
      wrong[key] = odd;
      const fs::path tileset = write_paged_scene(folder, wrong, 3);
      try {
        static_cast<void>(show_finest({tileset}));
      } catch (const Error& error) {
        EXPECT_EQ(error.what(), import_error(tileset)) << key << odd;
      }
    }
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::minutes(5));
}

TEST(ImportTilesetPages, OfThePitAreWhatIsWalkedOn) {
  ROAM_NEEDS_TEST_DATA();
  const fs::path tileset = test_data() / "pit_3dtiles/tileset.json";
  const ImportOptions options{.up = UpAxis::y};
  const Finest shown = show_finest({tileset}, options);
  EXPECT_EQ(shown.triangles.size(), 177'950u);
  EXPECT_EQ(not_shown(import_scene(tileset, options), shown, 1e-5), 0u);
  EXPECT_EQ(shown.missing, 0u);
  // The tile itself, and one page for each tile that others replace.
  EXPECT_EQ(shown.pages_read, 1u + 293u - 220u);
}

}  // namespace
}  // namespace roam::test
