// Damaged files of every format: whatever a byte says, reading ends in a scene or in a message, within the budget.
// ROAM_MUTATIONS says how many of each format.

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "archive_made.h"
#include "gltf_made.h"
#include "import_files.h"
#include "roam/import.h"

namespace roam::test {
namespace {

namespace fs = std::filesystem;

int mutations() {
  const char* wanted = std::getenv("ROAM_MUTATIONS");
  return wanted == nullptr ? 4 : std::atoi(wanted);
}

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A tetrahedron in formats of text that no scene of the folder of test data has.
const std::string tetrahedron_off = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const std::string tetrahedron_ac =
    "AC3Db\nMATERIAL \"m\" rgb 1 1 1 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 10 trans 0\nOBJECT world\nkids 1\nOBJECT "
    "poly\nname \"t\"\nnumvert 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\nnumsurf 4\nSURF 0x20\nmat 0\nrefs 3\n0 0 0\n2 0 0\n1 0 "
    "0\nSURF 0x20\nmat 0\nrefs 3\n0 0 0\n1 0 0\n3 0 0\nSURF 0x20\nmat 0\nrefs 3\n1 0 0\n2 0 0\n3 0 0\nSURF 0x20\nmat "
    "0\nrefs 3\n2 0 0\n0 0 0\n3 0 0\nkids 0\n";
const std::string triangles_dxf =
    "0\nSECTION\n2\nENTITIES\n0\n3DFACE\n8\n0\n10\n0\n20\n0\n30\n0\n11\n1\n21\n0\n31\n0\n12\n0\n22\n1\n32\n0\n13\n0\n23"
    "\n1\n"
    "33\n0\n0\n3DFACE\n8\n0\n10\n0\n20\n0\n30\n1\n11\n1\n21\n0\n31\n1\n12\n0\n22\n1\n32\n1\n13\n0\n23\n1\n33\n1\n0\nEND"
    "SEC\n0\n"
    "EOF\n";

/// A real scene in a format that assimp writes.
std::string exported(const fs::path& scene, const char* format, const fs::path& file) {
  Assimp::Importer importer;
  const aiScene* read = importer.ReadFile(scene.string(), aiProcess_Triangulate | aiProcess_JoinIdenticalVertices);
  Assimp::Exporter exporter;
  if (read == nullptr || exporter.Export(read, format, file.string()) != aiReturn_SUCCESS) return {};
  return content_of(file);
}

/// A composite tile of a glTF grid and of two instances of it.
std::string composite_tile() {
  const std::string glb = MadeGrid(3).gltf().glb();
  const std::string places = packed(std::vector<float>{0, 0, 0, 9, 0, 0});
  return made_composite({made_tile("b3dm", glb),
                         made_tile("i3dm", glb, R"({"INSTANCES_LENGTH":2,"POSITION":{"byteOffset":0}})", places)});
}

/// A tileset with an implicit tree, and the files that it names in `folder`.
std::string tileset_of_trees(const fs::path& folder) {
  const Json everywhere{{"constant", 1}}, nowhere{{"constant", 0}};
  std::ofstream(folder / "0.cmpt", std::ios::binary) << composite_tile();
  std::ofstream(folder / "s.json") << Json{
      {"tileAvailability", everywhere}, {"contentAvailability", everywhere}, {"childSubtreeAvailability", nowhere}};
  Json trees = made_node("0.cmpt");
  trees["implicitTiling"] = {{"subdivisionScheme", "QUADTREE"},
                             {"subtreeLevels", 3},
                             {"availableLevels", 3},
                             {"subtrees", {{"uri", "s.json"}}}};
  Json root = made_node("", Json::array({made_node("0.cmpt"), trees}));
  root["transform"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 100, 0, 0, 1};
  return made_tileset(root);
}

/// A scene to damage: a file of the folder of test data, or the name of a format.
std::string good_file(const std::string& name, const fs::path& folder) {
  if (name == ".cmpt") return composite_tile();
  if (name == ".json") return tileset_of_trees(folder);
  if (name == ".3tz") {
    const Json root = made_node("1.cmpt", Json::array({made_node("2.cmpt"), made_node("inner.json")}));
    return made_archive({{"tileset.json", made_tileset(root), 8},
                         {"1.cmpt", composite_tile()},
                         {"2.cmpt", composite_tile(), 8},
                         {"inner.json", made_tileset(made_node("1.cmpt"))}});
  }
  if (name == ".off") return tetrahedron_off;
  if (name == ".ac") return tetrahedron_ac;
  if (name == ".dxf") return triangles_dxf;
  const fs::path scene = test_data() / "recast/nav_test.obj";
  if (name == ".3ds") return exported(scene, "3ds", folder / "good.3ds");
  if (name == ".fbx") return exported(scene, "fbxa", folder / "good.fbx");
  if (name == ".gltf") return exported(scene, "gltf2", folder / "good.gltf");
  return content_of(test_data() / name);
}

/// Flips bits, writes extreme bytes, cuts, repeats or moves a stretch: one to four of these.
std::string damaged(std::string bytes, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  const std::size_t changes = 1 + below(4);
  for (std::size_t i = 0; i < changes && !bytes.empty(); ++i) {
    const std::size_t at = below(bytes.size());
    const std::size_t length = std::min(bytes.size() - at, 1 + below(64));
    switch (below(6)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        for (std::size_t k = 0; k < std::min<std::size_t>(length, 8); ++k) bytes[at + k] = '\xff';
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 4:
        bytes.erase(at, length);
        break;
      default:
        bytes[at] = static_cast<char>(below(256));
        break;
    }
  }
  return bytes;
}

/// Processor seconds of the children that have ended.
double seconds_of_children() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

class ImportMutations : public testing::TestWithParam<const char*> {};

TEST_P(ImportMutations, EndInASceneOrAMessageWithinTheBudget) {
  ROAM_NEEDS_TEST_DATA();
  const TemporaryFolder folder;
  const std::string name = GetParam();
  const std::string good = good_file(name, folder.path());
  ASSERT_FALSE(good.empty());
  const std::string extension = name.starts_with(".") ? name : fs::path(name).extension().string();
  ASSERT_EQ(import_error(folder.write("good" + extension, good)), "");
  std::mt19937 random(20261122);
  // What the reader may take, and what it uses up between two looks at it.
  const double budget = std::max(10.0, 3e-6 * static_cast<double>(good.size())) + 2.0;
  int scenes = 0, messages = 0;
  for (int i = 0; i < mutations(); ++i) {
    const fs::path file = folder.write("scene" + extension, damaged(good, random));
    const double before = seconds_of_children();
    ImportOptions options;
    options.memory_limit = 1u << 30;
    const std::string error = import_error(file, options);
    ++(error.empty() ? scenes : messages);
    EXPECT_LT(seconds_of_children() - before, budget) << "mutation " << i << " of " << GetParam() << ": " << error;
    EXPECT_FALSE(contains(error, "something that no scene needs")) << i << error;
    EXPECT_FALSE(contains(error, "broken, or not the roam-reader")) << i << error;
  }
  EXPECT_EQ(scenes + messages, mutations());
}

INSTANTIATE_TEST_SUITE_P(Formats, ImportMutations,
                         testing::Values("recast/nav_test.obj", "building/cpr_obstacle_world.stl",
                                         "formats/pittsburgh_mine.ply", "formats/pittsburgh_mine.osg",
                                         "formats/pittsburgh_mine.osgt", "formats/pittsburgh_mine.flt",
                                         "underground/subt_tunnel_practice_1.ive",
                                         "contextcapture_tiles/fanvanzh_test.osgb",
                                         "underground/subt_tiles/tunnel_tile_2/meshes/tunnel_tile_2.dae",
                                         "building/small_house.glb", "bim/Duplex_A_20110907.ifc", ".off", ".ac", ".dxf",
                                         ".3ds", ".fbx", ".gltf", ".cmpt", ".json", ".3tz"));

}  // namespace
}  // namespace roam::test
