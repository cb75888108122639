// A store is up to date, and belongs to its scene, only while every file that its reader opened or missed is the same.
#include <fcntl.h>
#include <sys/stat.h>

#include <functional>

#include "import/parts.h"
#include "store/build/fingerprint.h"
#include "store/build/same_scene.h"
#include "store/files.h"
#include "store/manifest.h"
#include "store_builds.h"

namespace {

using namespace store_builds;
using roam::store::LookUps;
using roam::store::reference_file;
using roam::store::reference_name;
using roam::store::SourcePart;
using roam::store::Sources;

/// A triangle at height z, as an .osg file.
std::string triangle_osg(const std::string& z) {
  return "Geode {\n num_drawables 1\n Geometry {\n  PrimitiveSets 1\n  {\n   DrawArrays TRIANGLES 0 3\n  }\n"
         "  VertexArray Vec3Array 3\n  {\n   0 0 " +
         z + "\n   1 0 " + z + "\n   0 1 " + z + "\n  }\n }\n}\n";
}

/// A triangle and what a file gives, as an .osg file.
std::string osg_with(const std::string& proxies, int count = 1) {
  return "Group {\n num_children " + std::to_string(1 + count) + "\n" + triangle_osg("0") + proxies + "}\n";
}

std::string proxy(const std::string& file) {
  return "ProxyNode {\nFileNameList 1 {\n\"" + file + "\"\n}\nnum_children 0\n}\n";
}

std::string paged(const std::string& file) {
  return "PagedLOD {\nRangeMode PIXEL_SIZE_ON_SCREEN\nRangeList 2 {\n0 100\n100 1e+30\n}\nFileNameList 2 {\n\"\"\n\"" +
         file + "\"\n}\nnum_children 1\n" + triangle_osg("0") + "}\n";
}

/// The same as proxy(), as a tile: the reader of .osgb knows its text form by its first word.
std::string proxy_osgb(const std::string& file) {
  return "#Ascii Scene\n#Version 161\n#Generator OpenSceneGraph 3.6.5\n\nosg::ProxyNode {\n UniqueID 1\n FileNames 1 "
         "{\n  \"" +
         file + "\"\n }\n}\n";
}

/// The corners of a triangle at height z, as a buffer of glTF.
std::string buffer(float z) {
  const float corners[9] = {0, z, 0, 1, z, 0, 0, z, 1};
  return {reinterpret_cast<const char*>(corners), sizeof corners};
}

/// A triangle in the last of these buffers.
std::string gltf(const std::string& buffers, int last, const std::string& generator = "x") {
  return R"({"asset":{"version":"2.0","generator":")" + generator +
         R"("},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[)" +
         buffers + R"(],"bufferViews":[{"buffer":)" + std::to_string(last) +
         R"(,"byteOffset":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,)"
         R"("type":"VEC3","min":[0,-9,0],"max":[1,9,1]}]})";
}

std::string chunk(const std::string& type, std::string bytes) {
  while (bytes.size() % 4 != 0) bytes.push_back(type == "JSON" ? ' ' : '\0');
  const auto size = static_cast<std::uint32_t>(bytes.size());
  return std::string(reinterpret_cast<const char*>(&size), 4) + type + bytes;
}

std::string glb(const std::string& json) {
  const std::string chunks = chunk("JSON", json) + chunk(std::string("BIN\0", 4), buffer(5));
  const std::uint32_t head[2] = {2, static_cast<std::uint32_t>(12 + chunks.size())};
  return "glTF" + std::string(reinterpret_cast<const char*>(head), 8) + chunks;
}

/// A scene with a file that it refers to.
struct Kind {
  std::string scene, text;  ///< path and content of the file that refers
  std::string named;        ///< path of the other file
  std::function<std::string(int height)> content{};
  std::string built{};  ///< the scene, if it is no file
};

std::vector<Kind> kinds() {
  const auto osg = [](int height) { return triangle_osg(std::to_string(height)); };
  const auto bin = [](int height) { return buffer(static_cast<float>(height)); };
  return {
      {"proxy/main.osg", osg_with(proxy("walls.osg")), "proxy/walls.osg", osg},
      {"page/main.osg", osg_with(paged("deep/walls.osg")), "page/deep/walls.osg", osg},
      {"osgt/main.osgt", proxy_osgb("walls.osg"), "osgt/walls.osg", osg},
      {"tiles/Data/Tile_1/Tile_1.osgb", proxy_osgb("../shared/walls.osg"), "tiles/Data/shared/walls.osg", osg, "tiles"},
      {"utf/s.gltf", gltf(R"({"byteLength":36,"uri":"b.bin"})", 0, "\xff"), "utf/b.bin", bin},
      {"plain/s.gltf", gltf(R"({"byteLength":36,"uri":"b.bin"})", 0), "plain/b.bin", bin},
      {"percent/s.gltf", gltf(R"({"byteLength":36,"uri":"a%20b.bin"})", 0), "percent/a%20b.bin", bin},
      {"glb/s.glb", glb(gltf(R"({"byteLength":36},{"byteLength":36,"uri":"b.bin"})", 1)), "glb/b.bin", bin}};
}

/// Why roam view does not use the store for the scene.
std::string difference(const roam::StoreBuildOptions& o) {
  return roam::store::difference(*roam::Store::open(o.output), o.scene, o.import, o.lossless, o.key, [] {});
}

/// Builds again, and expects what a first build gives.
void expect_read_again(const roam::StoreBuildOptions& o, const TestFolder& folder) {
  EXPECT_NE(difference(o), "");
  const auto built = roam::build_store(o);
  EXPECT_FALSE(built.unchanged);
  EXPECT_EQ(built.parts_read, 1U);
  auto fresh = o;
  fresh.output = folder.file("fresh");
  fs::remove_all(fresh.output);
  roam::build_store(fresh);
  expect_same(o.output.string(), fresh.output.string());
  EXPECT_EQ(difference(o), "");
  EXPECT_TRUE(roam::build_store(o).unchanged);
}

TEST(StoreReferences, BelongToTheirPart) {
  for (const Kind& kind : kinds()) {
    SCOPED_TRACE(kind.scene);
    const TestFolder folder;
    for (const std::string& file : {kind.scene, kind.named})
      fs::create_directories(fs::path(folder.file(file)).parent_path());
    (void)folder.write(kind.scene, kind.text);
    (void)folder.write(kind.named, kind.content(2));
    const auto o = options({folder.file(kind.built.empty() ? kind.scene : kind.built)}, folder.file("s"));
    roam::build_store(o);
    EXPECT_EQ(difference(o), "");
    EXPECT_TRUE(roam::build_store(o).unchanged);
    (void)folder.write(kind.named, kind.content(3));
    expect_read_again(o, folder);
  }
}

TEST(StoreReferences, ThatAreAbsentMayComeAndGo) {
  const TestFolder folder;
  const auto o = options({folder.write("main.osg", osg_with(proxy("walls.osg")))}, folder.file("s"));
  roam::build_store(o);
  EXPECT_TRUE(roam::build_store(o).unchanged);
  const std::string walls = folder.write("walls.osg", triangle_osg("2"));
  expect_read_again(o, folder);
  EXPECT_EQ(roam::Store::open(folder.file("s"))->info().triangles, 2U);
  fs::remove(walls);
  expect_read_again(o, folder);
  EXPECT_EQ(roam::Store::open(folder.file("s"))->info().triangles, 1U);
}

TEST(StoreReferences, DecideWhetherABuildIsContinued) {
  const TestFolder folder;
  (void)folder.write("walls.osg", triangle_osg("2"));
  const auto o = options({folder.write("main.osg", osg_with(proxy("walls.osg")))}, folder.file("s"));
  roam::StoreBuildReport first, second;
  static_cast<void>(roam::plan_store(o, first));
  static_cast<void>(roam::plan_store(o, second));
  EXPECT_EQ(first.parts_read, 1U);
  EXPECT_EQ(second.parts_read, 0U);
  (void)folder.write("walls.osg", triangle_osg("3"));
  EXPECT_EQ(roam::build_store(o).parts_read, 1U);
  roam::build_store(options({folder.file("main.osg")}, folder.file("fresh")));
  expect_same(folder.file("s"), folder.file("fresh"));
}

TEST(StoreReferences, MustBeTheSameForARepair) {
  const TestFolder folder;
  const std::string walls = folder.write("walls.osg", triangle_osg("2"));
  const auto o = options({folder.write("main.osg", osg_with(proxy("walls.osg")))}, folder.file("s"));
  roam::build_store(o);
  const auto before = content(folder.file("s"));
  const fs::path pack = fs::directory_iterator(folder.file("s") + "/packs")->path();
  fs::resize_file(pack, 10);
  (void)folder.write("walls.osg", triangle_osg("3"));
  EXPECT_NE(refusal([&] { roam::repair_store(o); }).find("was not made of this scene as it is now"), std::string::npos);
  (void)folder.write("walls.osg", triangle_osg("2"));
  EXPECT_EQ(roam::repair_store(o).shards_built, 1U);
  EXPECT_TRUE(content(folder.file("s")) == before);
}

TEST(StoreReferences, AreReadAgainIfAManifestDoesNotRecordThem) {
  const TestFolder folder;
  (void)folder.write("walls.osg", triangle_osg("2"));
  const auto o = options({folder.write("main.osg", osg_with(proxy("walls.osg")))}, folder.file("s"));
  roam::build_store(o);
  const auto right = roam::store::read_manifest(*roam::store::files_of(o.output), "s");
  ASSERT_EQ(right.parts.at(0).references, std::vector<std::string>{"walls.osg"});
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{},
                                                {"../walls.osg"},
                                                {"walls.osg", "/etc/passwd"},
                                                {"x/../walls.osg"},
                                                {"main.osg/"}}) {
    auto forged = right;
    forged.parts[0].references = wrong;
    roam::store::publish(o.output, forged);
    EXPECT_NE(difference(o), "");
    EXPECT_EQ(roam::build_store(o).parts_read, 1U);
    EXPECT_EQ(difference(o), "");
  }
}

TEST(StoreReferences, AreNotRecordedBeyondTheirLimit) {
  const TestFolder folder;
  std::string proxies;
  const std::string deep = std::string(200, 'a') + "/" + std::string(200, 'b') + "/" + std::string(200, 'c') + "/";
  constexpr int count = 6000;
  for (int i = 0; i < count; ++i) proxies += proxy(deep + std::to_string(i) + std::string(100, 'd') + ".osg");
  const auto o = options({folder.write("main.osg", osg_with(proxies, count))}, folder.file("s"));
  roam::build_store(o);
  const auto before = content(folder.file("s"));
  EXPECT_TRUE(roam::store::read_manifest(*roam::store::files_of(o.output), "s").parts.at(0).references.empty());
  EXPECT_NE(difference(o), "");
  EXPECT_EQ(roam::build_store(o).parts_read, 1U);
  EXPECT_TRUE(content(folder.file("s")) == before);
}

TEST(StoreReferences, OfInventorAreNotKnownSoItIsReadEveryTime) {
  if (roam::reader_confinement().landlock < 1) GTEST_SKIP() << "Inventor files are not read here";
  const TestFolder folder;
  const auto o = options({folder.write("main.iv",
                                       "#Inventor V2.1 ascii\nSeparator {\n Coordinate3 { point [0 0 0, 1 0 0, 0 1 "
                                       "0] }\n FaceSet { numVertices 3 }\n}\n")},
                         folder.file("s"));
  roam::build_store(o);
  const auto before = content(folder.file("s"));
  EXPECT_NE(difference(o), "");
  EXPECT_EQ(roam::build_store(o).parts_read, 1U);
  EXPECT_TRUE(content(folder.file("s")) == before);
}

TEST(StoreReferences, HaveNamesThatStayInTheScene) {
  roam::reader::SceneScope scope;
  scope.scene = "/a/scene.osg";
  scope.folders = {"/a", "/allowed"};
  for (const char* file : {"/a/b.osg", "/a/c/d%20.osg", "/a/\xff\n.osg", "/allowed/x.osg", "/a/..b"}) {
    const auto name = reference_name(file, scope);
    ASSERT_TRUE(name) << file;
    EXPECT_EQ(reference_file(*name, scope), fs::path(file));
  }
  EXPECT_EQ(reference_name("/a/\xff\n%.osg", scope), "%FF%0A%25.osg");
  EXPECT_FALSE(reference_name("/b/x.osg", scope));
  EXPECT_FALSE(reference_name("/allowed", scope));
  for (const char* name : {"", ".", "..", "../x", "b/../c", "./b", "b//c", "b/", "/", "/etc/passwd", "/a/b.osg",
                           "/allowed", "/allowed/../x", "%2E%2E/x", "%2e%2e/x", "a%00b", "a%"}) {
    EXPECT_FALSE(reference_file(name, scope)) << name;
  }
}

TEST(StoreReferences, AreTheFilesThatTheReaderSaw) {
  const TestFolder folder;
  const std::string scene = folder.write("main.osg", "text"), other = folder.write("other.osg", "text");
  struct stat status {};
  ASSERT_EQ(::stat(other.c_str(), &status), 0);
  const std::int64_t changed = std::int64_t{status.st_ctim.tv_sec} * 1'000'000'000 + status.st_ctim.tv_nsec;
  const auto said = [&](const roam::FileLookUp& seen) {
    Sources sources(folder.file(""), std::nullopt, {});
    SourcePart part;
    part.name = "part";
    part.path = scene;
    part.files = {scene};
    LookUps look_ups(part, sources.scope(scene), 1 << 20);
    look_ups.add(seen);
    for (const auto& [name, file] : look_ups.files()) part.references.emplace(name, file.file);
    sources.look({part}, [] {});
    return refusal([&] { sources.check_unchanged(part, look_ups); });
  };
  EXPECT_EQ(said({other, true, 4, changed}), "");
  EXPECT_EQ(said({folder.file("none.osg"), false, 0, 0}), "");
  for (const roam::FileLookUp& seen :
       {roam::FileLookUp{other, true, 4, changed - 1}, roam::FileLookUp{other, true, 5, changed},
        roam::FileLookUp{other, false, 0, 0}, roam::FileLookUp{folder.file("none.osg"), true, 4, changed}}) {
    EXPECT_NE(said(seen).find("was changed while the scene was read"), std::string::npos);
  }
}

}  // namespace
