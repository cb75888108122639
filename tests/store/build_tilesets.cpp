// A tileset's contents are parts of a build, which reads again what changed.
#include "gltf_made.h"
#include "store/opened.h"
#include "store_builds.h"

namespace {

using namespace store_builds;
using roam::test::made_node;
using roam::test::made_tile;
using roam::test::made_tileset;
using roam::test::MadeGrid;

TEST(StoreTilesets, AreReadAgainTileByTile) {
  const TestFolder folder;
  fs::create_directories(folder.file("city"));
  const auto write_tile = [&](int i, float height) {
    (void)folder.write("city/" + std::to_string(i) + ".b3dm", made_tile("b3dm", MadeGrid(8, height).gltf().glb()));
  };
  const auto write_tileset = [&](int tiles) {
    roam::test::Json children = roam::test::Json::array();
    for (int i = 1; i <= tiles; ++i) children.push_back(made_node(std::to_string(i) + ".b3dm"));
    (void)folder.write("city/tileset.json", made_tileset(made_node("", children)));
  };
  for (int i = 1; i <= 4; ++i) write_tile(i, static_cast<float>(i));
  write_tileset(3);
  const auto o = options({folder.file("city/tileset.json")}, folder.file("s"));
  EXPECT_EQ(roam::build_store(o).parts_read, 4U);  // the tileset itself, and three tiles
  EXPECT_TRUE(roam::build_store(o).unchanged);

  write_tile(2, 7.0f);
  // All tiles lie in one shard, which is built from each of them. The tileset is as before.
  EXPECT_EQ(roam::build_store(o).parts_read, 3U);
  write_tileset(4);
  EXPECT_EQ(roam::build_store(o).parts_read, 5U);
  auto fresh = o;
  fresh.output = folder.file("fresh");
  roam::build_store(fresh);
  expect_same(o.output.string(), fresh.output.string());

  fs::remove(folder.file("city/3.b3dm"));
  EXPECT_EQ(roam::build_store(o).parts_read, 4U);
  const std::string notes = roam::test::Json(roam::Store::open(o.output)->state().manifest.notes).dump();
  EXPECT_NE(notes.find("3.b3dm"), std::string::npos) << notes;
}

TEST(StoreTilesets, ReadAFileOnceThoughManyTilesNameIt) {
  const TestFolder folder;
  using roam::test::Json;
  const Json everywhere{{"constant", 1}}, nowhere{{"constant", 0}};
  (void)folder.write(
      "s.json",
      Json{{"tileAvailability", everywhere}, {"contentAvailability", everywhere}, {"childSubtreeAvailability", nowhere}}
          .dump());
  (void)folder.write("a.glb", MadeGrid(8).gltf().glb());
  Json root = made_node("a.glb");
  root["implicitTiling"] = {{"subdivisionScheme", "QUADTREE"},
                            {"subtreeLevels", 4},
                            {"availableLevels", 4},
                            {"subtrees", {{"uri", "s.json"}}}};
  const std::string tileset = folder.write("tileset.json", made_tileset(root));
  EXPECT_EQ(roam::build_store(options({tileset}, folder.file("s"))).parts_read, 2U);  // not 65
}

TEST(StoreTilesets, RefuseNamesThatTakeMostOfTheMemory) {
  const TestFolder folder;
  roam::test::MadeGltf gltf = MadeGrid(1).gltf();
  gltf.json["meshes"].push_back(gltf.json["meshes"][0]);
  for (int i : {0, 1}) gltf.json["meshes"][i]["name"] = std::string(60'000, static_cast<char>('a' + i));
  const auto read = [&](int objects) {
    gltf.json["nodes"] = roam::test::Json::array();
    for (int i = 0; i < objects; ++i) {
      gltf.json["nodes"].push_back({{"mesh", i % 2}});
      gltf.json["scenes"][0]["nodes"][i] = i;
    }
    auto o = options({folder.write("scene.glb", gltf.glb())}, folder.file("s"));
    o.memory = roam::StoreBuildOptions::least_memory;
    return roam::build_store(o).parts_read;
  };
  EXPECT_EQ(read(10'000), 1U);
  try {
    (void)read(40'000);
    ADD_FAILURE() << "names of 2.4 GB in the file's words";
  } catch (const roam::Error& error) {
    EXPECT_NE(std::string(error.what()).find("the names of its "), std::string::npos) << error.what();
  }
}

}  // namespace
