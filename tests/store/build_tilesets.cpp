// A tileset's contents are parts of a build, which reads again what changed.
#include "archive_made.h"
#include "gltf_made.h"
#include "store/opened.h"
#include "store_builds.h"

namespace {

using namespace store_builds;
using roam::test::made_node;
using roam::test::made_tile;
using roam::test::made_tileset;
using roam::test::MadeGrid;

/// The fingerprints of a store's parts.
std::vector<std::string> fingerprints(const fs::path& store) {
  std::vector<std::string> all;
  const auto opened = roam::Store::open(store);
  for (const auto& part : opened->state().manifest.parts) all.push_back(part.fingerprint);
  return all;
}

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
  const std::vector<std::string> before = fingerprints(o.output);
  write_tileset(4);
  EXPECT_EQ(roam::build_store(o).parts_read, 5U);
  const std::vector<std::string> now = fingerprints(o.output);
  EXPECT_EQ(std::vector(now.begin() + 1, now.begin() + 4), std::vector(before.begin() + 1, before.end()));
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

/// A tileset of three tiles in an archive and in a folder; one of them keeps its vertices in another file.
struct City {
  std::vector<float> heights{1.0f, 2.0f, 3.0f};

  [[nodiscard]] std::vector<roam::test::MadeEntry> entries() const {
    roam::test::MadeGltf third = MadeGrid(8, heights[2]).gltf();
    third.json["buffers"] = {{{"byteLength", third.buffer.size()}, {"uri", "3.bin"}}};
    const auto tile = [&](int i) { return made_tile("b3dm", MadeGrid(8, heights[i]).gltf().glb()); };
    const roam::test::Json children = {made_node("1.b3dm"), made_node("2.b3dm"), made_node("3.gltf")};
    return {{"tileset.json", made_tileset(made_node("", children)), 8},
            {"1.b3dm", tile(0), 8},
            {"2.b3dm", tile(1)},
            {"3.gltf", third.json.dump(), 8},
            {"3.bin", third.buffer, 8}};
  }
};

/// The files of a store without its manifest, which has the names of the scene.
std::map<std::string, std::string> geometry(const fs::path& store) {
  std::map<std::string, std::string> files = content(store.string());
  std::erase_if(files,
                [](const auto& file) { return !file.first.starts_with("pack") && !file.first.starts_with("part"); });
  return files;
}

TEST(StoreTilesets, InAnArchiveAreReadAgainEntryByEntry) {
  const TestFolder folder;
  City city;
  const auto write = [&] { return folder.write("city.3tz", roam::test::made_archive(city.entries())); };
  const auto o = options({write()}, folder.file("s"));
  EXPECT_EQ(roam::build_store(o).parts_read, 4U);
  EXPECT_TRUE(roam::build_store(o).unchanged);
  const std::vector<std::string> before = fingerprints(o.output);

  fs::create_directories(folder.file("loose/city"));
  for (const auto& entry : city.entries()) (void)folder.write("loose/city/" + entry.name, entry.content);
  const auto loose = options({folder.file("loose/city")}, folder.file("l"));
  roam::build_store(loose);
  EXPECT_FALSE(geometry(o.output).empty());
  EXPECT_TRUE(geometry(o.output) == geometry(loose.output));

  // The same entries at other places.
  auto moved = city.entries();
  moved.insert(moved.begin(), {"README", "a city"});
  (void)folder.write("city.3tz", roam::test::made_archive(moved));
  roam::build_store(o);
  const std::vector<std::string> there = fingerprints(o.output);
  EXPECT_EQ(std::vector(there.begin(), there.begin() + 3), std::vector(before.begin(), before.begin() + 3));
  EXPECT_NE(there[3], before[3]);  // it names another entry, so it depends on the archive

  city.heights[0] = 7.0f;
  write();
  EXPECT_GT(roam::build_store(o).parts_read, 0U);
  std::vector<std::string> now = fingerprints(o.output);
  EXPECT_EQ(now[0], before[0]);
  EXPECT_NE(now[1], before[1]);
  EXPECT_EQ(now[2], before[2]);

  city.heights[2] = 9.0f;  // only 3.bin is another one
  write();
  EXPECT_FALSE(roam::build_store(o).unchanged);
  auto fresh = o;
  fresh.output = folder.file("fresh");
  roam::build_store(fresh);
  expect_same(o.output.string(), fresh.output.string());
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
