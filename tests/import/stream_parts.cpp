// The parts of a scene: what they are called, what they are read from, and that together they are the scene.

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "import/parts.h"
#include "import_pieces.h"

namespace roam::test {
namespace {

namespace fs = std::filesystem;

/// A tile of one triangle with a corner at (x, 0, 0): the reader of .osgb knows its text form by its first word.
std::string tile(const std::string& x) {
  return "#Ascii Scene\n#Version 161\n#Generator OpenSceneGraph 3.6.5\n\nosg::Geode {\n UniqueID 1\n Drawables 1 {\n  "
         "osg::Geometry {\n"
         "   UniqueID 2\n   PrimitiveSetList 1 {\n    osg::DrawArrays {\n     UniqueID 3\n     Mode TRIANGLES\n"
         "     Count 3\n    }\n   }\n   VertexArray TRUE {\n    osg::Vec3Array {\n     UniqueID 4\n"
         "     Binding BIND_PER_VERTEX\n     vector 3 {\n      " +
         x + " 0 0\n      0 1 0\n      0 0 1\n     }\n    }\n   }\n  }\n }\n}\n";
}

std::string metadata(const std::string& srs, const std::string& origin) {
  return "<ModelMetadata version=\"1\"><SRS>" + srs + "</SRS><SRSOrigin>" + origin + "</SRSOrigin></ModelMetadata>\n";
}

class ImportStreamParts : public testing::Test {
 protected:
  /// A scene of two folders of tiles and a file. One tile is missing.
  std::vector<fs::path> write_scene(const std::string& where) {
    for (const char* folder : {"east", "west"}) {
      for (const char* name : {"Tile_1", "Tile_2", "Tile_4"}) {
        const std::string x = std::string(folder == std::string("east") ? "1" : "2") + (name + 5);
        folder_.write(where + "/" + folder + "/Data/" + name + "/" + name + ".osgb", tile(x));
        folder_.write(where + "/" + folder + "/Data/" + name + "/" + name + "_L20.osgb", "a page");
      }
      folder_.write(where + "/" + folder + "/Data/Tile_3/Tile_3_L20.osgb", "a page without its tile");
    }
    folder_.write(where + "/east/metadata.xml", metadata("ENU", "100,20,3"));
    folder_.write(where + "/west/metadata.xml", metadata("ENU", "110.5,20,3"));
    folder_.write(where + "/house.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder_.write(where + "/old/house.obj", "v 0 0 5\nv 1 0 5\nv 0 1 5\nf 1 2 3\n");
    const fs::path base = folder_.path() / where;
    return {base / "east", base / "west/", base / "house.obj", base / "old/house.obj"};
  }

  const TemporaryFolder folder_;
};

std::vector<std::string> names_of(const std::vector<ScenePart>& parts) {
  std::vector<std::string> names;
  for (const ScenePart& part : parts) names.push_back(part.name);
  return names;
}

/// Reads part after part; what they report is put together.
ImportReport stream_parts(const std::vector<ScenePart>& parts, Pieces& pieces) {
  ImportReport all;
  for (const ScenePart& part : parts) {
    const ImportReport report = stream_part(part, {}, pieces.sink());
    all.files += report.files;
    all.triangles += report.triangles;
    all.missing_pages += report.missing_pages;
    all.missing_page_files.insert(all.missing_page_files.end(), report.missing_page_files.begin(),
                                  report.missing_page_files.end());
    if (!all.georeference) all.georeference = report.georeference;
  }
  return all;
}

void expect_parts_are_the_scene(const std::vector<fs::path>& paths) {
  const ImportedScene scene = import_scene(paths);
  Pieces pieces;
  const ImportReport report = stream_parts(scene_parts(paths), pieces);
  EXPECT_EQ(report.files, scene.report.files);
  EXPECT_EQ(report.triangles, scene.report.triangles);
  EXPECT_EQ(report.missing_pages, scene.report.missing_pages);
  EXPECT_EQ(report.missing_page_files, scene.report.missing_page_files);
  ASSERT_EQ(report.georeference.has_value(), scene.report.georeference.has_value());
  if (report.georeference) {
    EXPECT_EQ(report.georeference->origin, scene.report.georeference->origin);
  }
  EXPECT_TRUE(same_bits(pieces.triangles, triangles_of(scene)));
}

TEST_F(ImportStreamParts, AreTheSceneOneAfterTheOther) {
  const std::vector<fs::path> paths = write_scene("scene");
  expect_parts_are_the_scene(paths);
  Pieces pieces;
  stream_parts(scene_parts(paths), pieces);
  ASSERT_EQ(pieces.triangles.size(), 8u);
  EXPECT_EQ(pieces.triangles[0][0], Vec3(11, 0, 0));
  // The second folder is placed in the frame of the first.
  EXPECT_EQ(pieces.triangles[3][0], Vec3(21 + 10.5, 0, 0));
}

TEST_F(ImportStreamParts, AreTheSceneWhereItIsReal) {
  ROAM_NEEDS_TEST_DATA();
  expect_parts_are_the_scene({test_data() / "pit_osgb", test_data() / "recast/dungeon.obj"});
}

TEST_F(ImportStreamParts, AreCalledTheSameWhereverTheSceneLies) {
  const std::vector<std::string> names = names_of(scene_parts(write_scene("here")));
  EXPECT_EQ(names,
            (std::vector<std::string>{"east/Tile_3", "east/Tile_1", "east/Tile_2", "east/Tile_4", "west/Tile_3",
                                      "west/Tile_1", "west/Tile_2", "west/Tile_4", "house.obj", "house.obj (2)"}));
  EXPECT_EQ(names_of(scene_parts(write_scene("over/there"))), names);
  EXPECT_EQ(names_of(scene_parts(std::vector<fs::path>{folder_.path() / "here/east/Data"}))[1], "east/Tile_1");
}

TEST_F(ImportStreamParts, TellTheirFiles) {
  const std::vector<fs::path> paths = write_scene("scene");
  const std::vector<ScenePart> parts = scene_parts(paths);
  ASSERT_EQ(parts.size(), 10u);
  const ScenePart &missing = parts[0], &first = parts[1], &second_folder = parts[5], &file = parts[8];
  EXPECT_TRUE(missing.files.empty());
  EXPECT_EQ(first.files, (std::vector<fs::path>{paths[0] / "Data/Tile_1/Tile_1.osgb",
                                                paths[0] / "Data/Tile_1/Tile_1_L20.osgb", paths[0] / "metadata.xml"}));
  std::uint64_t bytes = 0;
  for (const fs::path& name : first.files) bytes += fs::file_size(name);
  EXPECT_EQ(first.bytes, bytes);
  EXPECT_FALSE(first.frame);
  ASSERT_TRUE(second_folder.frame);
  EXPECT_EQ(second_folder.frame->origin, Vec3(100, 20, 3));
  EXPECT_EQ(file.files, std::vector<fs::path>{paths[2]});
  EXPECT_EQ(file.bytes, fs::file_size(paths[2]));
  EXPECT_EQ(file.tile, "");
}

TEST_F(ImportStreamParts, TellWhatTheirReaderLookedUp) {
  const fs::path scene = folder_.write("look/scene.osg",
                                       "Group {\n num_children 2\n"
                                       "ProxyNode {\nFileNameList 1 {\n\"there.osg\"\n}\nnum_children 0\n}\n"
                                       "ProxyNode {\nFileNameList 1 {\n\"gone.osg\"\n}\nnum_children 0\n}\n}\n");
  const fs::path there = folder_.write("look/there.osg", "Group {\n num_children 0\n}\n");
  std::map<fs::path, FileLookUp> found;
  Pieces pieces;
  try {
    stream_part(scene_parts({{scene}}).at(0), {}, pieces.sink(),
                [&](const FileLookUp& file) { EXPECT_TRUE(found.emplace(file.file, file).second) << file.file; });
  } catch (const Error&) {  // it has no triangle
  }
  ASSERT_TRUE(found.contains(scene) && found.contains(there) && found.contains(folder_.path() / "look/gone.osg"));
  EXPECT_TRUE(found.at(scene).found && found.at(there).found);
  EXPECT_EQ(found.at(there).bytes, fs::file_size(there));
  EXPECT_GT(found.at(there).changed_ns, 0);
  EXPECT_FALSE(found.at(folder_.path() / "look/gone.osg").found);
}

TEST_F(ImportStreamParts, OfATileThatIsMissingGiveNothingAndSaySo) {
  std::vector<ScenePart> parts = scene_parts(write_scene("scene"));
  Pieces pieces;
  EXPECT_EQ(stream_part(parts[0], {}, pieces.sink()).missing_pages, 1u);
  // One that went away since.
  fs::remove_all(folder_.path() / "scene/east/Data/Tile_1");
  EXPECT_EQ(stream_part(parts[1], {}, pieces.sink()).missing_pages, 1u);
  EXPECT_TRUE(pieces.triangles.empty());
}

TEST_F(ImportStreamParts, OfATileThatIsMissingNeedNoReader) {
  const std::vector<ScenePart> parts = scene_parts(write_scene("scene"));
  ImportOptions options;
  options.reader = folder_.path() / "no-reader";
  Pieces pieces;
  EXPECT_THROW(stream_part(parts[1], options, pieces.sink()), Error);
  const ImportReport report = stream_part(parts[4], options, pieces.sink());
  EXPECT_EQ(report.missing_page_files,
            (std::vector<std::string>{(folder_.path() / "scene/west/Data/Tile_3/Tile_3.osgb").string()}));
  ASSERT_TRUE(report.georeference);
  EXPECT_EQ(report.georeference->origin, Vec3(100, 20, 3));
  options.progress = [](const ImportProgress&) { return false; };
  EXPECT_THROW(stream_part(parts[4], options, pieces.sink()), Cancelled);
}

TEST_F(ImportStreamParts, AreListedOnlyAsLongAsTheProgressAgrees) {
  folder_.write("many/Data/Tile_0/Tile_0.osgb", tile("1"));
  constexpr int count = 300;
  for (int i = 0; i < count; ++i)
    fs::create_directories(folder_.path() / "many/Data" / ("Tile_" + std::string(i % 2, '\xff') + std::to_string(i)));
  ImportOptions options;
  int asked = 0;
  options.progress = [&](const ImportProgress&) { return ++asked > 0; };
  const std::vector<fs::path> paths{folder_.path() / "many"};
  static_cast<void>(scene_parts(paths, options));
  EXPECT_GE(asked, count);
}

TEST_F(ImportStreamParts, HaveNamesOfTheirOwnThoughTheyEscapeAlike) {
  for (const char* name : {"\xff\xff", "%FF\xff", "\xff%FF", "%FF%FF"})
    folder_.write(std::string("alike/Data/Tile_") + name + "/Tile_" + name + ".osgb", tile("1"));
  const auto names = names_of(scene_parts(std::vector<fs::path>{folder_.path() / "alike"}));
  EXPECT_EQ(names, (std::vector<std::string>{"alike/Tile_%FF%FF", "alike/Tile_%FF%FF (2)", "alike/Tile_%FF%FF (3)",
                                             "alike/Tile_%FF%FF (4)"}));
}

TEST_F(ImportStreamParts, AreRefusedWhereFoldersLieInEachOtherWithoutEnd) {
  static_cast<void>(write_scene("scene"));
  fs::path deep = "scene/east/Data/Tile_1";
  for (int i = 0; i < 80; ++i) deep /= "a";
  fs::create_directories(folder_.path() / deep);
  try {
    static_cast<void>(scene_parts(std::vector<fs::path>{folder_.path() / "scene/east/Data"}));
    ADD_FAILURE() << "they were looked through";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("Data/Tile_1: more than"), std::string::npos) << error.what();
  }
}

TEST_F(ImportStreamParts, AreRefusedAsTheSceneIs) {
  const auto error_of = [](const std::vector<fs::path>& paths) -> std::string {
    try {
      return scene_parts(paths).empty() ? "no part" : "";
    } catch (const Error& error) {
      return error.what();
    }
  };
  for (const fs::path& path : {folder_.path() / "none.obj", folder_.write("points.las", "x"),
                               folder_.write("empty.obj", ""), folder_.write("no/Data/readme", "x").parent_path()}) {
    const std::string wanted = import_error(path);
    ASSERT_NE(wanted, "");
    EXPECT_EQ(error_of({path}), wanted);
  }
  folder_.write("a/Data/Tile_1/Tile_1.osgb", tile("1"));
  folder_.write("a/metadata.xml", metadata("ENU", "1,2,3"));
  folder_.write("b/Data/Tile_1/Tile_1.osgb", tile("1"));
  folder_.write("b/metadata.xml", metadata("EPSG:2056", "1,2,3"));
  EXPECT_TRUE(contains(error_of({folder_.path() / "a", folder_.path() / "b"}), "into one system first"));
}

}  // namespace
}  // namespace roam::test
