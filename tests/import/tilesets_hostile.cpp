// What hostile glTF and 3D Tiles may not do: hide a wall from bodies or from eyes, or cost more than their files
// justify.

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "gltf_made.h"
#include "import/parts.h"
#include "import/processor_budget.h"
#include "import/reader/machine_failure.h"
#include "import/reader/piece_cutter.h"
#include "import_files.h"
#include "roam/error.h"
#include "roam/import.h"
#include "sanitizer.h"
#include "shown_scene.h"

namespace roam::test {
namespace {

namespace fs = std::filesystem;

constexpr int type_i8 = 5120;

/// TMPDIR has another value as long as this object lives.
class TemporaryFolderIs {
 public:
  explicit TemporaryFolderIs(const fs::path& folder) {
    if (const char* before = std::getenv("TMPDIR")) before_ = before;
    setenv("TMPDIR", folder.c_str(), 1);
  }
  ~TemporaryFolderIs() { before_.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", before_.c_str(), 1); }
  TemporaryFolderIs(const TemporaryFolderIs&) = delete;
  TemporaryFolderIs& operator=(const TemporaryFolderIs&) = delete;

 private:
  std::string before_;
};

/// Makes the mesh of node 0 appear at `count` places, as one object.
void repeat(MadeGltf& gltf, std::size_t count) {
  std::vector<float> places;
  for (std::size_t i = 0; i < count; ++i) places.insert(places.end(), {4.0f * static_cast<float>(i), 0, 0});
  const auto accessor = gltf.add_accessor(packed(places), type_f32, "VEC3", count);
  gltf.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = accessor;
}

/// A tileset of these contents, all of which are its finest level.
fs::path write_tileset(const TemporaryFolder& folder, const std::vector<std::string>& contents) {
  Json children = Json::array();
  for (const std::string& content : contents) children.push_back(made_node(content));
  return folder.write("tileset.json", made_tileset(made_node("", children)));
}

std::string error_of_parts(const fs::path& tileset, const ImportOptions& options) {
  try {
    for (const ScenePart& part : scene_parts({&tileset, 1}, options)) {
      stream_part(part, options, [](const Mesh&, bool) {});
    }
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ImportTilesetsHostile, EndLoudlyWhereATileDoesNotFitMemoryAndDisk) {
  ROAM_NEEDS_PLAIN_MEMORY();
  const TemporaryFolder folder;
  MadeGltf gravel = MadeGrid(20).gltf();
  repeat(gravel, 1500);
  folder.write("gravel.glb", gravel.glb());
  folder.write("floor.glb", MadeGrid(1).gltf().glb());
  const fs::path tileset = write_tileset(folder, {"gravel.glb", "floor.glb"});
  const ImportOptions little{.memory_limit = 64u << 20};
  {
    const TemporaryFolderIs none(folder.path() / "none");
    EXPECT_TRUE(contains(error_of_parts(tileset, little), "TMPDIR"));
    EXPECT_THROW(stream_scene({&tileset, 1}, little, [](const Mesh&, bool) {}), Error);
    EXPECT_EQ(error_of_parts(tileset, {}), "");  // with memory enough
  }
  EXPECT_EQ(error_of_parts(tileset, little), "");
}

/// An implicit quadtree of that many levels, all of whose tiles have the contents a.glb and b.glb.
fs::path write_quadtree(const TemporaryFolder& folder, int levels) {
  const Json everywhere{{"constant", 1}}, nowhere{{"constant", 0}};
  folder.write("s.json", Json{{"tileAvailability", everywhere},
                              {"contentAvailability", {everywhere, everywhere}},
                              {"childSubtreeAvailability", nowhere}}
                             .dump());
  for (const char* name : {"a.glb", "b.glb"}) folder.write(name, MadeGrid(1).gltf().glb());
  Json root = made_node("");
  root["contents"] = {{{"uri", "a.glb"}}, {{"uri", "b.glb"}}};
  root["implicitTiling"] = {{"subdivisionScheme", "QUADTREE"},
                            {"subtreeLevels", levels},
                            {"availableLevels", levels},
                            {"subtrees", {{"uri", "s.json"}}}};
  return folder.write("tileset.json", made_tileset(root));
}

TEST(ImportTilesetsHostile, HaveOnePartForAFileAtOnePlace) {
  const TemporaryFolder folder;
  const fs::path tileset = write_quadtree(folder, 5);
  const std::vector<ScenePart> parts = scene_parts({&tileset, 1});
  EXPECT_EQ(parts.size(), 3u);  // the outline and two contents, not 512
  EXPECT_EQ(import_scene(tileset).report.triangles, 4u);
}

/// `count` tiles of that content, each at another place.
Json nodes_of(const std::string& content, int count, double step) {
  Json children = Json::array();
  for (int i = 0; i < count; ++i) {
    Json& child = children.emplace_back(made_node(content));
    child["transform"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, step * i, 0, 0, 1};
  }
  return made_node("", children);
}

TEST(ImportTilesetsHostile, CountPartsAgainstTheMemory) {
  const TemporaryFolder folder;
  folder.write("a.glb", MadeGrid(1).gltf().glb());
  folder.write("inner.json", made_tileset(nodes_of("a.glb", 250, 1)));
  const fs::path tileset = folder.write("tileset.json", made_tileset(nodes_of("inner.json", 250, 1000)));
  try {
    static_cast<void>(scene_parts({&tileset, 1}, {.memory_limit = 80u << 20}));
    ADD_FAILURE() << "62,500 parts from 30 kB";
  } catch (const Error& error) {
    EXPECT_TRUE(contains(error.what(), "of memory that importing may use")) << error.what();
  }
}

TEST(ImportTilesetsHostile, AreNotHeldForMissingIfTheDiskFails) {
  for (const int reason : {0, ENOENT, ENOTDIR, EACCES, ELOOP, ENAMETOOLONG}) {
    EXPECT_NO_THROW(reader::fail_unless_missing(reason, "tile.glb")) << reason;
  }
  for (const int reason : {EIO, ESTALE, EMFILE, ENOMEM, ETIMEDOUT}) {
    EXPECT_THROW(reader::fail_unless_missing(reason, "tile.glb"), reader::MachineFailure) << reason;
  }
}

TEST(ImportTilesetsHostile, ReadAllPartsWithinOneBudget) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("a.glb", MadeGrid(1).gltf().glb());
  const std::vector<ScenePart> parts = scene_parts({&file, 1});
  reader::SceneBudget budget;
  const auto read = [&] {
    return stream_part(
               parts.at(0), {}, [](const Mesh&, bool) {}, {}, &budget)
        .triangles;
  };
  EXPECT_EQ(read(), 2u);
  const double allowed = budget.allowed();
  EXPECT_EQ(read(), 2u);
  EXPECT_EQ(budget.allowed(), allowed);  // a file counts once
  static_cast<void>(budget.add(2 * allowed));
  try {
    read();
    ADD_FAILURE() << "read beyond the budget";
  } catch (const Error& error) {
    EXPECT_TRUE(contains(error.what(), "the readers of its parts computed for more than 10 s together"));
  }
}

TEST(ImportTilesetsHostile, FindNoFileDeeperThanSixtyFourFolders) {
  const TemporaryFolder folder;
  std::string deep, deeper;
  for (int i = 0; i < 64; ++i) deep += "d/";
  deeper = deep + "d/";
  for (const std::string& place : {deep, deeper}) folder.write(place + "a.glb", MadeGrid(1).gltf().glb());
  EXPECT_EQ(import_scene(write_tileset(folder, {deep + "a.glb"})).report.triangles, 2u);
  EXPECT_NE(import_error(write_tileset(folder, {deeper + "a.glb"})), "");
}

TEST(ImportTilesetsHostile, ShowTheTrianglesThatStopBodiesWhateverIsWrongWithLooks) {
  const TemporaryFolder folder;
  for (const char* attribute : {"NORMAL", "COLOR_0", "TEXCOORD_0"}) {
    MadeGltf wall = MadeGrid(1, 5).gltf();
    wall.json["accessors"].push_back({{"bufferView", 0}, {"componentType", type_f32}, {"type", "VEC3"}, {"count", 60}});
    wall.json["meshes"][0]["primitives"][0]["attributes"][attribute] = wall.json["accessors"].size() - 1;
    folder.write("wall.glb", wall.glb());
    folder.write("floor.glb", MadeGrid(1).gltf().glb());
    const fs::path tileset = write_tileset(folder, {"floor.glb", "wall.glb"});
    const Finest shown = show_finest({tileset});
    EXPECT_EQ(shown.triangles.size(), 4u) << attribute;
    EXPECT_EQ(shown.triangles.size(), triangles_of(import_scene(tileset)).size());
    ASSERT_EQ(shown.notes.size(), 1u);
    EXPECT_TRUE(contains(shown.notes[0], std::string(attribute) + " of its vertices is damaged"));
  }
}

/// A grid with an image in a buffer view of its own, whose index the image states as `view`.
MadeGltf with_image(const std::string& image) {
  MadeGltf gltf = MadeGrid(1).gltf();
  const auto coordinates = gltf.add_accessor(packed(std::vector<float>(8)), type_f32, "VEC2", 4);
  gltf.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = coordinates;
  gltf.json["meshes"][0]["primitives"][0]["material"] = 0;
  gltf.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  gltf.json["textures"] = {{{"source", 0}}};
  gltf.json["images"] = {{{"bufferView", gltf.add_view(image)}, {"mimeType", "image/bmp"}}};
  return gltf;
}

/// A BMP file of one red texel.
std::string red_bmp() {
  return "BM" + packed(std::vector<std::uint32_t>{58, 0, 54, 40, 1, 1, 1 | 24 << 16, 0, 4, 2835, 2835, 0, 0}) +
         std::string("\0\0\xff\0", 4);
}

TEST(ImportTilesetsHostile, ShowTheImagesOfATileThatIsDamagedLater) {
  const TemporaryFolder folder;
  MadeGltf tile = with_image(red_bmp());
  tile.add_mesh({{"attributes", {{"POSITION", 77}}}});
  tile.json["nodes"].push_back({{"mesh", 1}});
  tile.json["scenes"][0]["nodes"] = {0, 1};
  folder.write("tile.glb", tile.glb());
  folder.write("floor.glb", MadeGrid(1, 5).gltf().glb());
  const Finest shown = show_finest({write_tileset(folder, {"tile.glb", "floor.glb"})});
  ASSERT_EQ(shown.triangles.size(), 4u);
  EXPECT_EQ(shown.images, 1u);
  EXPECT_EQ(shown.missing, 1u);
  ASSERT_EQ(shown.notes.size(), 1u) << "no image is missing";
}

TEST(ImportTilesetsHostile, CountAnImageWithoutBytesAsMissing) {
  const TemporaryFolder folder;
  MadeGltf tile = with_image(red_bmp());
  tile.json["images"][0]["bufferView"] = 99;
  const fs::path file = folder.write("tile.glb", tile.glb());
  const Shown alone = show({file});
  EXPECT_EQ(alone.triangles.size(), 2u);
  EXPECT_EQ(alone.report.missing_textures, 1u);
  EXPECT_EQ(alone.report.import.missing_pages, 0u);
  const Finest in_tileset = show_finest({write_tileset(folder, {"tile.glb"})});
  EXPECT_EQ(in_tileset.triangles.size(), 2u);
  EXPECT_EQ(in_tileset.missing, 0u);
  ASSERT_EQ(in_tileset.notes.size(), 1u);
  EXPECT_TRUE(contains(in_tileset.notes[0], "1 image that the scene refers to is absent or unreadable"));
}

TEST(ImportTilesetsHostile, LeaveOutATileWithANumberBeyondDoubles) {
  const TemporaryFolder folder;
  folder.write("bad.gltf", R"({"asset":{"version":"2.0"},"x":1e999})");
  folder.write("floor.glb", MadeGrid(1).gltf().glb());
  const ImportedScene scene = import_scene(write_tileset(folder, {"floor.glb", "bad.gltf"}));
  EXPECT_EQ(scene.report.triangles, 2u);
  EXPECT_EQ(scene.report.missing_pages, 1u);
}

TEST(ImportTilesetsHostile, LeaveOutATileWhoseTransformsOverflow) {
  const TemporaryFolder folder;
  folder.write("a.glb", MadeGrid(1).gltf().glb());
  folder.write("b.glb", MadeGrid(1).gltf().glb());
  Json huge = made_node("", Json::array({made_node("b.glb")}));
  huge["transform"] = huge["children"][0]["transform"] = {1e200, 0, 0, 0, 0, 1e200, 0, 0, 0, 0, 1e200, 0, 0, 0, 0, 1};
  const fs::path tileset =
      folder.write("tileset.json", made_tileset(made_node("", Json::array({made_node("a.glb"), huge}))));
  EXPECT_EQ(import_scene(tileset).report.missing_pages, 1u);
  EXPECT_EQ(error_of_parts(tileset, {}), "");
}

TEST(ImportTilesetsHostile, RefuseInstancesWhoseAttributesDifferInNumber) {
  const TemporaryFolder folder;
  MadeGltf gltf = MadeGrid(1).gltf();
  const auto none = gltf.add_accessor(std::string(16, '\0'), type_f32, "VEC3", 0);
  gltf.json["bufferViews"].back()["byteStride"] = std::uint64_t{1} << 40;
  const auto many = gltf.add_accessor(std::string(64 * 4, '\0'), type_i8, "VEC4", 64);
  gltf.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", none},
                                                                                  {"ROTATION", many}};
  EXPECT_TRUE(contains(import_error(folder.write("a.glb", gltf.glb())), "attributes of instances differ in number"));
}

TEST(ImportTilesetsHostile, FindVerticesOfAPieceInAFewSteps) {
  constexpr unsigned bits = 19;
  constexpr std::uint32_t vertices = 3u << 16;
  // A row of new vertices around each place where the former table met itself.
  for (std::uint32_t k = 0; k < 8; ++k) {
    std::vector<bool> taken(std::size_t{1} << bits);
    std::uint64_t steps = 0;
    const std::uint32_t first = (k << bits) - (k == 0 ? 0 : vertices / 2);
    for (std::uint32_t i = 0; i < vertices; ++i) {
      std::uint32_t at = reader::first_entry(first + i, bits);
      while (taken[at]) {
        at = (at + 1) % (1u << bits);
        ++steps;
      }
      taken[at] = true;
    }
    EXPECT_LT(steps, 8u * vertices) << k;
  }
}

}  // namespace
}  // namespace roam::test
