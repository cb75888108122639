// 3D Tiles: which tiles are read, where they lie, and what hostile tilesets cost.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "gltf_made.h"
#include "import/parts.h"
#include "import_files.h"
#include "roam/error.h"

namespace roam::test {
namespace {

namespace fs = std::filesystem;

/// A tile that is a grid at that height above the tile's zero. Its first corner names it.
std::string grid_tile(float height) { return made_tile("b3dm", MadeGrid(1, height).gltf().glb()); }

/// The heights of the triangles' first corners without their relief, each once.
std::set<double> heights_of(const ImportedScene& scene) {
  std::set<double> heights;
  for (const Triangle& t : triangles_of(scene)) heights.insert(std::floor(t[0].z + 1e-9));
  return heights;
}

/// Writes tiles of heights 1, 2, ... and a tileset of them.
fs::path write_scene(const TemporaryFolder& folder, const Json& root, int tiles) {
  for (int i = 1; i <= tiles; ++i) {
    folder.write("tiles/" + std::to_string(i) + ".b3dm", grid_tile(static_cast<float>(i)));
  }
  return folder.write("tiles/tileset.json", made_tileset(root));
}

Json two_levels(const char* refine) { return made_node("1.b3dm", {made_node("2.b3dm"), made_node("3.b3dm")}, refine); }

using Heights = std::set<double>;

TEST(ImportTilesets, ReadTheFinestLevel) {
  const TemporaryFolder folder;
  const ImportedScene scene = import_scene(write_scene(folder, two_levels("REPLACE"), 3));
  EXPECT_EQ(heights_of(scene), (Heights{2, 3}));
  EXPECT_EQ(scene.report.triangles, 4u);
  EXPECT_TRUE(scene.report.notes.empty());
  // The folder is the same scene.
  EXPECT_EQ(triangles_of(import_scene(folder.path() / "tiles")), triangles_of(scene));
  EXPECT_EQ(heights_of(import_scene(write_scene(folder, two_levels("ADD"), 3))), (Heights{1, 2, 3}));
  EXPECT_EQ(heights_of(import_scene(folder.path() / "tiles/2.b3dm")), Heights{2});
}

TEST(ImportTilesets, ReadACoarserTileInPlaceOfMissingOnes) {
  const TemporaryFolder folder;
  const fs::path tileset = write_scene(folder, two_levels("REPLACE"), 2);
  for (const char* content : {"", "b3dm", "version https://git-lfs.github.com/spec/v1\n"}) {
    if (*content != '\0') folder.write("tiles/3.b3dm", content);
    const ImportedScene scene = import_scene(tileset);
    EXPECT_EQ(heights_of(scene), Heights{1}) << content;
    EXPECT_EQ(scene.report.missing_pages, 1u);
    EXPECT_TRUE(contains(scene.report.missing_page_files.at(0), "tiles/3.b3dm"));
    EXPECT_TRUE(notes_contain(scene, "1 of its coarser tiles stand in for finer ones"));
  }
  fs::remove(folder.path() / "tiles/1.b3dm");
  EXPECT_EQ(heights_of(import_scene(tileset)), Heights{2});
  fs::remove(folder.path() / "tiles/2.b3dm");
  fs::remove(folder.path() / "tiles/3.b3dm");
  EXPECT_TRUE(contains(import_error(tileset), "none of the 3 files that it refers to is there and whole"));
}

TEST(ImportTilesets, MultiplyTransformsInDoubles) {
  const TemporaryFolder folder;
  Json root = made_node("", Json::array({made_node("1.b3dm")}));
  root["transform"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1000.0625, 2000, 3000, 1};
  // By a quarter turn around z, and twice as large.
  root["children"][0]["transform"] = {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 10, 20, 30, 1};
  const Triangle moved = triangles_of(import_scene(write_scene(folder, root, 1))).at(0);
  const Triangle plain = triangles_of(import_scene(folder.path() / "tiles/1.b3dm")).at(0);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(moved[k], Vec3(1010.0625 - 2 * plain[k].y, 2020 + 2 * plain[k].x, 3030 + 2 * plain[k].z));
  }
}

TEST(ImportTilesets, TurnContentUprightAndMoveItToItsCentre) {
  const TemporaryFolder folder;
  const Json root = made_node("1.b3dm");
  const auto read = [&](const std::string& tile, const Json& asset = {{"version", "1.0"}}) {
    folder.write("tiles/1.b3dm", tile);
    return triangles_of(import_scene(folder.write("tiles/tileset.json", made_tileset(root, asset)))).at(0);
  };
  const std::string glb = MadeGrid(1, 5).gltf().glb();
  const Triangle plain = read(made_tile("b3dm", glb));
  EXPECT_LE(plain[1].y, 0.0);
  const Triangle as_stored = read(made_tile("b3dm", glb), {{"version", "1.0"}, {"gltfUpAxis", "Z"}});
  EXPECT_EQ(as_stored[1], Vec3(plain[1].x, plain[1].z, 0.0 - plain[1].y));
  const std::string json = R"({"BATCH_LENGTH":0,"RTC_CENTER":[1000000,2000000.5,3000000]})";
  EXPECT_EQ(read(made_tile("b3dm", glb, json))[1] - plain[1], Vec3(1e6, 2000000.5, 3e6));
  const std::string binary = packed(std::vector<float>{1000.5f, 2000, 3000});
  EXPECT_EQ(read(made_tile("b3dm", glb, R"({"RTC_CENTER":{"byteOffset":0}})", binary))[0] - plain[0],
            Vec3(1000.5, 2000, 3000));
}

TEST(ImportTilesets, ReadInstancesAndComposites) {
  const TemporaryFolder folder;
  const std::string glb = MadeGrid(1, 1).gltf().glb();
  const std::string positions = packed(std::vector<float>{0, 0, 0, 100, 0, 0});
  const std::string json = R"({"INSTANCES_LENGTH":2,"POSITION":{"byteOffset":0},"SCALE":{"byteOffset":24}})";
  const std::string instances = made_tile("i3dm", glb, json, positions + packed(std::vector<float>{1, 3}));
  const auto two = triangles_of(import_scene(folder.write("two.i3dm", instances)));
  ASSERT_EQ(two.size(), 4u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(two[2][k], 3.0 * two[0][k] + Vec3(100, 0, 0));

  const std::string named = made_tile("i3dm", "shape%20a.glb   ", json, positions + packed(std::vector<float>{1, 3}));
  std::string by_name = named;
  by_name[28] = '\0';
  folder.write("shape a.glb", glb);
  EXPECT_EQ(triangles_of(import_scene(folder.write("named.i3dm", by_name))), two);

  const std::string quantized =
      R"({"INSTANCES_LENGTH":1,"POSITION_QUANTIZED":{"byteOffset":0},"QUANTIZED_VOLUME_OFFSET":[10,0,0],)"
      R"("QUANTIZED_VOLUME_SCALE":[100,1,1],"NORMAL_UP":{"byteOffset":8},"NORMAL_RIGHT":{"byteOffset":20}})";
  const std::string table =
      packed(std::vector<std::uint16_t>{65535, 0, 0, 0}) + packed(std::vector<float>{-1, 0, 0, 0, 1, 0});
  const auto turned = triangles_of(import_scene(folder.write("q.i3dm", made_tile("i3dm", glb, quantized, table))));
  // x to y, y to -x.
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(turned[0][k], Vec3(110.0 - two[0][k].y, two[0][k].x, two[0][k].z)) << k;
  }
  EXPECT_TRUE(contains(import_error(folder.write("cut.i3dm", made_tile("i3dm", glb, json, positions))),
                       "reaches beyond the tile"));

  const std::string composite = made_composite({grid_tile(7), made_composite({instances, grid_tile(8)})});
  EXPECT_EQ(import_scene(folder.write("all.cmpt", composite)).report.triangles, 2u + 4u + 2u);
  EXPECT_TRUE(contains(import_error(folder.write("cut.cmpt", composite.substr(0, composite.size() - 40))),
                       "reaches beyond its end"));
}

TEST(ImportTilesets, FollowOtherTilesetsOnce) {
  const TemporaryFolder folder;
  folder.write("tiles/deep/inner.json", made_tileset(made_node("../2.b3dm?v=3")));
  const ImportedScene scene =
      import_scene(write_scene(folder, made_node("1.b3dm", Json::array({made_node("deep/inner.json")})), 2));
  EXPECT_EQ(heights_of(scene), Heights{2});
  // A tileset that names itself, or one above it, is incomplete.
  folder.write("tiles/deep/inner.json", made_tileset(made_node("../tileset.json")));
  const ImportedScene circle = import_scene(folder.path() / "tiles/tileset.json");
  EXPECT_EQ(heights_of(circle), Heights{1});
  EXPECT_TRUE(notes_contain(circle, "this tileset contains itself"));
  folder.write("tiles/deep/inner.json", "{\"asset\":");
  EXPECT_TRUE(notes_contain(import_scene(folder.path() / "tiles/tileset.json"), "it is no JSON"));
}

TEST(ImportTilesets, LeaveOutPointsByName) {
  const TemporaryFolder folder;
  folder.write("tiles/trees.pnts", "pnts" + packed(std::vector<std::uint32_t>{1, 28, 0, 0, 0, 0}));
  Json root = made_node("1.b3dm", Json::array({made_node("trees.pnts")}), "ADD");
  const ImportedScene scene = import_scene(write_scene(folder, root, 1));
  EXPECT_EQ(heights_of(scene), Heights{1});
  EXPECT_TRUE(notes_contain(scene, "1 of its tiles are points or lines"));
  EXPECT_TRUE(notes_contain(scene, "trees.pnts"));
  EXPECT_EQ(scene.report.missing_pages, 0u);
}

/// An implicit quadtree of two levels in subtrees of one level each; 1.b3dm to 5.b3dm are its contents.
Json implicit_root() {
  Json root = made_node("c/{level}/{x}/{y}.b3dm");
  root["implicitTiling"] = {{"subdivisionScheme", "QUADTREE"},
                            {"subtreeLevels", 1},
                            {"availableLevels", 2},
                            {"subtrees", {{"uri", "s/{level}.{x}.{y}.subtree"}}}};
  return root;
}

std::string subtree(const Json& json, const std::string& binary = "") {
  const std::string text = json.dump();
  return "subt" + packed(std::vector<std::uint32_t>{1}) +
         packed(std::vector<std::uint64_t>{text.size(), binary.size()}) + text + binary;
}

const Json everything{{"constant", 1}}, nothing{{"constant", 0}};

TEST(ImportTilesets, ReadImplicitTilingBySubtrees) {
  const TemporaryFolder folder;
  const fs::path tileset = folder.write("tiles/tileset.json", made_tileset(implicit_root()));
  // Children (0,0), (1,0) and (0,1), by bits.
  folder.write("tiles/s/0.0.0.subtree",
               subtree({{"buffers", {{{"byteLength", 8}}}},
                        {"bufferViews", {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 1}}}},
                        {"tileAvailability", everything},
                        {"contentAvailability", {everything}},
                        {"childSubtreeAvailability", {{"bitstream", 0}}}},
                       std::string("\x07\0\0\0\0\0\0\0", 8)));
  const std::string leaf = Json{
      {"tileAvailability", everything},
      {"contentAvailability", {everything}},
      {"childSubtreeAvailability",
       nothing}}.dump();
  float height = 1;
  folder.write("tiles/c/0/0/0.b3dm", grid_tile(height++));
  for (const char* place : {"0.0", "1.0", "0.1"}) {
    folder.write(std::string("tiles/s/1.") + place + ".subtree", subtree(Json::parse(leaf)));
    std::string file = place;
    file[1] = '/';
    folder.write("tiles/c/1/" + file + ".b3dm", grid_tile(height++));
  }
  EXPECT_EQ(heights_of(import_scene(tileset)), (Heights{2, 3, 4}));
  // Subtrees as JSON.
  folder.write("tiles/s/1.1.0.subtree", leaf);
  EXPECT_EQ(heights_of(import_scene(tileset)), (Heights{2, 3, 4}));
  fs::remove(folder.path() / "tiles/s/1.1.0.subtree");
  const ImportedScene coarse = import_scene(tileset);
  EXPECT_EQ(heights_of(coarse), Heights{1});
  EXPECT_EQ(coarse.report.missing_pages, 1u);
}

/// Earth-centred coordinates of a place in degrees and metres (EPSG:9602).
Vec3 earth_centred(double latitude, double longitude, double height) {
  constexpr double a = 6378137.0, f = 1.0 / 298.257223563, degree = std::numbers::pi / 180.0;
  const double e2 = f * (2 - f), phi = latitude * degree, lambda = longitude * degree;
  const double n = a / std::sqrt(1 - e2 * std::sin(phi) * std::sin(phi));
  return {(n + height) * std::cos(phi) * std::cos(lambda), (n + height) * std::cos(phi) * std::sin(lambda),
          (n * (1 - e2) + height) * std::sin(phi)};
}

TEST(ImportTilesets, MoveEarthCentredTilesToALocalFrame) {
  const TemporaryFolder folder;
  const Vec3 place = earth_centred(46.2, 8.1, 500);
  Json root = made_node("1.b3dm");
  root["boundingVolume"] = {{"box", {place.x, place.y, place.z, 100, 0, 0, 0, 100, 0, 0, 0, 100}}};
  folder.write("tiles/tileset.json", made_tileset(root));
  MadeGltf made;
  const Vec3 corners[3] = {place, earth_centred(46.2, 8.1, 510), earth_centred(46.201, 8.1, 500)};
  std::vector<float> relative;
  for (const Vec3& corner : corners) {
    for (int k = 0; k < 3; ++k) relative.push_back(static_cast<float>(corner[k] - place[k]));
  }
  made.add_mesh({{"attributes", {{"POSITION", made.add_accessor(packed(relative), type_f32, "VEC3", 3)}}}});
  // The tile's frame is z up, so that the file's (x, y, z) becomes (x, -z, y).
  made.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1};
  Json rtc = {{"RTC_CENTER", {place.x, place.y, place.z}}};
  folder.write("tiles/1.b3dm", made_tile("b3dm", made.glb(), rtc.dump()));
  const ImportedScene scene = import_scene(folder.path() / "tiles");
  const Triangle t = triangles_of(scene).at(0);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(t[0][k], Vec3(0, 0, 500)[k], 1e-8) << k;
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(t[1][k], Vec3(0, 0, 510)[k], 1e-6) << k;
  EXPECT_NEAR(t[2].y, 111.2, 0.2);
  EXPECT_NEAR(t[2].x, 0.0, 1e-3);
  ASSERT_TRUE(scene.report.georeference);
  EXPECT_EQ(scene.report.georeference->srs, "ENU:46.2,8.1");
  EXPECT_EQ(scene.report.georeference->origin, Vec3(0.0));
  EXPECT_TRUE(notes_contain(scene, "moved to the local frame 'ENU:46.2,8.1'"));
  // A region says so, too.
  constexpr double degree = std::numbers::pi / 180.0;
  root["boundingVolume"] = {
      {"region", {8.0999 * degree, 46.1999 * degree, 8.1001 * degree, 46.2001 * degree, 400, 600}}};
  folder.write("tiles/tileset.json", made_tileset(root));
  EXPECT_EQ(triangles_of(import_scene(folder.path() / "tiles")).at(0), t);
  // On demand the coordinates stay.
  const ImportedScene as_stored = import_scene(folder.path() / "tiles", {.up = UpAxis::z});
  EXPECT_LT(glm::length(triangles_of(as_stored).at(0)[0] - place), 1e-6);
  EXPECT_FALSE(as_stored.report.georeference);
  // A second tileset is moved into the frame of the first.
  fs::copy(folder.path() / "tiles", folder.path() / "again");
  const std::vector<Triangle> both = triangles_of(import_scene({folder.path() / "tiles", folder.path() / "again"}));
  EXPECT_EQ(both.at(1), both.at(0));
}

TEST(ImportTilesets, StandOnTheirTilesThoughTheRootIsTheWholeEarth) {
  const TemporaryFolder folder;
  const Vec3 place = earth_centred(46.2, 8.1, 500);
  constexpr double pi = std::numbers::pi;
  Json tile = made_node("1.b3dm"), half = made_node("", Json::array({tile}));
  half["boundingVolume"] = {{"region", {0, -pi / 2, pi, pi / 2, 0, 5000}}};
  half["children"][0]["boundingVolume"] = {{"box", {0, 0, 0, 100, 0, 0, 0, 100, 0, 0, 0, 100}}};
  half["children"][0]["transform"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, place.x, place.y, place.z, 1};
  Json root = made_node("", Json::array({made_node("absent.b3dm"), half}));
  root["boundingVolume"] = {{"region", {-pi, -pi / 2, pi, pi / 2, 0, 5000}}};
  const fs::path tileset = folder.write("tiles/tileset.json", made_tileset(root));
  folder.write("tiles/1.b3dm", made_tile("b3dm", MadeGrid(1).gltf().glb()));
  const ImportedScene scene = import_scene(tileset);
  ASSERT_TRUE(scene.report.georeference);
  EXPECT_EQ(scene.report.georeference->srs, "ENU:46.2,8.1");
  EXPECT_TRUE(notes_contain(scene, "the ground is level only near the place of the frame"));
}

/// The triangles of all parts, one after the other.
std::vector<Triangle> triangles_of_parts(const std::vector<ScenePart>& parts, const ImportOptions& options = {}) {
  std::vector<Triangle> all;
  for (const ScenePart& part : parts) {
    stream_part(part, options, [&](const Mesh& piece, bool) {
      for (std::size_t i = 0; i < piece.triangles.size(); ++i) all.push_back(piece.triangle(i));
    });
  }
  return all;
}

TEST(ImportTilesets, HaveAPartForEachContent) {
  const TemporaryFolder folder;
  const fs::path tileset = write_scene(folder, two_levels("REPLACE"), 3);
  const std::vector<ScenePart> parts = scene_parts({&tileset, 1});
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts[0].name, "tiles/tileset.json");
  EXPECT_EQ(parts[1].name, "tiles/2.b3dm");
  EXPECT_EQ(parts[2].name, "tiles/3.b3dm");
  EXPECT_EQ(parts[1].files, std::vector<fs::path>{folder.path() / "tiles/2.b3dm"});
  EXPECT_EQ(triangles_of_parts(parts), triangles_of(import_scene(tileset)));
  // A tile that moves is another part; the others stay as they were.
  Json root = two_levels("REPLACE");
  root["children"][1]["transform"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1};
  write_scene(folder, root, 3);
  const std::vector<ScenePart> moved = scene_parts({&tileset, 1});
  EXPECT_EQ(moved[1].tile, parts[1].tile);
  EXPECT_NE(moved[2].tile, parts[2].tile);
  // The first part has the notes on the whole tileset.
  fs::remove(folder.path() / "tiles/3.b3dm");
  const std::vector<ScenePart> coarse = scene_parts({&tileset, 1});
  ASSERT_EQ(coarse.size(), 2u);
  EXPECT_NE(coarse[0].tile, moved[0].tile);
  EXPECT_EQ(stream_part(coarse[0], {}, [](const Mesh&, bool) {}).missing_pages, 1u);
}

TEST(ImportTilesets, CostLittleWhenTheyAreHostile) {
  const TemporaryFolder folder;
  const auto begin = std::chrono::steady_clock::now();
  // Addresses elsewhere.
  for (const char* uri :
       {"http://example.org/1.b3dm", "file:///etc/passwd", "data:,b3dm", "../../../../etc/passwd", "/etc/passwd",
        "..\\..\\secret.b3dm", "%2e%2e/%2e%2e/secret.b3dm", ".", "", "a\nb", "tileset.json"}) {
    const ImportedScene scene =
        import_scene(write_scene(folder, made_node("1.b3dm", {made_node(uri), made_node("2.b3dm")}), 2));
    EXPECT_EQ(heights_of(scene), *uri == '\0' ? Heights{2} : Heights{1}) << uri;
  }
  fs::create_symlink("/etc/passwd", folder.path() / "tiles/link.b3dm");
  const ImportedScene linked =
      import_scene(write_scene(folder, made_node("1.b3dm", Json::array({made_node("link.b3dm")})), 1));
  EXPECT_EQ(linked.report.outside_references, 1u);
  // Depth, in one file and over files.
  std::string deep;
  for (int i = 0; i < 10'000; ++i) deep += R"({"children":[)";
  folder.write("tiles/tileset.json", R"({"root":)" + deep);
  EXPECT_TRUE(contains(import_error(folder.path() / "tiles"), "nested more than"));
  Json root = made_node("1.b3dm");
  for (int i = 0; i < 1000; ++i) root = made_node("", Json::array({root}));
  EXPECT_TRUE(contains(import_error(write_scene(folder, root, 1)), "nested more than 1000 deep"));
  for (int i = 0; i < 1100; ++i) {
    folder.write("tiles/" + std::to_string(i) + ".json", made_tileset(made_node(std::to_string(i + 1) + ".json")));
  }
  EXPECT_EQ(heights_of(import_scene(write_scene(folder, made_node("1.b3dm", Json::array({made_node("0.json")})), 1))),
            Heights{1});
  // Huge counts.
  for (const auto& [levels, subtree_levels] :
       {std::pair<Json, Json>{60, 20}, {1e300, 5}, {5, 60}, {-1, 1}, {5, "x"}, {2, 0}}) {
    Json endless = implicit_root();
    endless["implicitTiling"]["availableLevels"] = levels;
    endless["implicitTiling"]["subtreeLevels"] = subtree_levels;
    folder.write("tiles/s/0.0.0.subtree", Json{{"tileAvailability", everything},
                                               {"contentAvailability", {everything}},
                                               {"childSubtreeAvailability", nothing}}
                                              .dump());
    EXPECT_NE(import_error(write_scene(folder, endless, 0)), "") << levels;
  }
  // Wrong types everywhere.
  for (const Json& odd : {Json(1), Json("x"), Json(nullptr), Json::array({1, nullptr}), Json{{"uri", 7}}}) {
    for (const char* key :
         {"children", "content", "contents", "transform", "refine", "boundingVolume", "implicitTiling", "extensions"}) {
      Json wrong = two_levels("REPLACE");
      wrong[key] = odd;
      write_scene(folder, wrong, 3);
      static_cast<void>(import_error(folder.path() / "tiles/tileset.json"));
    }
  }
  EXPECT_TRUE(contains(import_error(folder.write("city.json", R"({"type":"CityJSON","version":"1.0"})")),
                       "CityJSON is not read yet"));
  EXPECT_TRUE(contains(import_error(folder.write("other.json", R"({"a":1})")), "this JSON is no tileset"));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::minutes(8));
}

}  // namespace
}  // namespace roam::test
