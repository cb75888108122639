// OpenSceneGraph scenes: transforms, switches, levels of detail, pages, proxies, folders of tiles.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "import_files.h"

namespace roam::test {
namespace {

/// A geode of one triangle with a corner at (x, 0, 0), in OpenSceneGraph's text format.
std::string triangle_at(const std::string& x, const std::string& name = "") {
  return "Geode {\n name \"" + name +
         "\"\n num_drawables 1\n Geometry {\n  Primitives 1\n  {\n   DrawArrays TRIANGLES 0 3\n" +
         "  }\n  VertexArray Vec3dArray 3\n  {\n   " + x + " 0 0\n   0 1 0\n   0 0 1\n  }\n }\n}\n";
}

std::string group(const std::string& kind, const std::string& fields, const std::vector<std::string>& children) {
  std::string text = kind + " {\n" + fields + "num_children " + std::to_string(children.size()) + "\n";
  for (const std::string& child : children) text += child;
  return text + "}\n";
}

/// The x of each triangle's first corner.
std::vector<double> first_xs(const ImportedScene& scene) {
  std::vector<double> xs;
  for (const Triangle& t : triangles_of(scene)) xs.push_back(t[0].x);
  return xs;
}

std::vector<double> xs_of(const std::string& content) {
  const TemporaryFolder folder;
  return first_xs(import_scene(folder.write("scene.osg", content)));
}

std::string moved(const std::string& x, const std::vector<std::string>& children,
                  const std::string& frame = "RELATIVE") {
  return group("MatrixTransform",
               "referenceFrame " + frame + "\nMatrix {\n1 0 0 0\n0 1 0 0\n0 0 1 0\n" + x + " 0 0 1\n}\n", children);
}

TEST(ImportSceneGraph, MultipliesTransformsInDoubles) {
  EXPECT_EQ(xs_of(moved("4000000", {moved("0.0625", {triangle_at("0.123456789012")})})),
            (std::vector<double>{4000000.0625 + 0.123456789012}));
}

TEST(ImportSceneGraph, ExpandsInstances) {
  EXPECT_EQ(xs_of(group("Group", "",
                        {moved("10", {"Geode {\n UniqueID shared\n" + triangle_at("1").substr(8)}),
                         moved("20", {"Use shared\n"})})),
            (std::vector<double>{11, 21}));
}

TEST(ImportSceneGraph, ReadsTheVisibleChildOfASwitch) {
  EXPECT_EQ(xs_of(group("Switch", "NewChildDefaultValue TRUE\nValueList {\n0\n1\n0\n}\n",
                        {triangle_at("1"), triangle_at("2"), triangle_at("3")})),
            (std::vector<double>{2}));
}

TEST(ImportSceneGraph, ReadsTheFinestLevelOfDetail) {
  const std::vector<std::string> levels{triangle_at("1"), triangle_at("2"), triangle_at("3")};
  EXPECT_EQ(xs_of(group("LOD", "RangeList 3 {\n500 1000\n0 100\n100 500\n}\n", levels)), (std::vector<double>{2}));
  EXPECT_EQ(xs_of(group("LOD", "RangeMode PIXEL_SIZE_ON_SCREEN\nRangeList 3 {\n0 10\n10 100\n100 1e10\n}\n", levels)),
            (std::vector<double>{3}));
  // Children whose ranges overlap are shown together.
  EXPECT_EQ(xs_of(group("LOD", "RangeList 3 {\n0 1000\n0 100\n100 500\n}\n", levels)), (std::vector<double>{1, 2}));
}

TEST(ImportSceneGraph, LeavesOutLevelsOfDetailThatContinueASibling) {
  const auto level = [](const std::string& range, const std::string& x) {
    return group("LOD", "RangeList 1 {\n" + range + "\n}\n", {triangle_at(x)});
  };
  EXPECT_EQ(xs_of(group("Group", "", {level("100 500", "1"), level("0 100", "2"), level("200 300", "3")})),
            (std::vector<double>{2, 3}));
}

TEST(ImportSceneGraph, LeavesOutBillboardsAndHiddenNodes) {
  const std::string billboard = "Billboard {\n Mode AXIAL\n Positions {\n 0 0 0\n }\n" + triangle_at("1").substr(8);
  const std::string hidden = "Geode {\n nodeMask 0x0\n" + triangle_at("2").substr(8);
  EXPECT_EQ(xs_of(group("Group", "", {billboard, hidden, triangle_at("3")})), (std::vector<double>{3}));
}

TEST(ImportSceneGraph, LeavesOutHeadUpDisplays) {
  const std::string projection =
      group("Projection", "Matrix {\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n}\n", {triangle_at("1")});
  EXPECT_EQ(xs_of(group("Group", "", {projection, moved("1", {triangle_at("1")}, "ABSOLUTE"), triangle_at("3")})),
            (std::vector<double>{3}));
}

TEST(ImportSceneGraph, ReadsAllPrimitivesInOrder) {
  const TemporaryFolder folder;
  std::string vertices;
  for (int i = 0; i < 6; ++i) vertices += std::to_string(i) + " 0 0\n";
  const auto corners = [&](const std::string& primitives) {
    std::string text;
    const std::string geode = "Geode {\nnum_drawables 1\nGeometry {\nPrimitives 1\n{\n" + primitives +
                              "\n}\nVertexArray Vec3Array 6\n{\n" + vertices + "}\n}\n}\n";
    for (const Triangle& t : triangles_of(import_scene(folder.write("primitives.osg", geode)))) {
      for (const Vec3& v : t) text += std::to_string(static_cast<int>(v.x));
      text += " ";
    }
    return text;
  };
  EXPECT_EQ(corners("DrawArrays TRIANGLES 0 6"), "012 345 ");
  EXPECT_EQ(corners("DrawArrays TRIANGLE_STRIP 0 5"), "012 213 234 ");
  EXPECT_EQ(corners("DrawArrays TRIANGLE_FAN 1 4"), "123 134 ");
  EXPECT_EQ(corners("DrawArrays POLYGON 0 5"), "012 023 034 ");
  EXPECT_EQ(corners("DrawArrays QUADS 0 4"), "012 023 ");
  EXPECT_EQ(corners("DrawArrays QUAD_STRIP 0 6"), "013 032 235 254 ");
  EXPECT_EQ(corners("DrawArrayLengths POLYGON 1 2 {\n3 2\n}"), "123 ");
  EXPECT_EQ(corners("DrawElementsUShort TRIANGLES 3 {\n5 0 2\n}"), "502 ");
}

TEST(ImportSceneGraph, ReadsVerticesThatAreIntegers) {
  for (const char* kind : {"Vec3sArray", "Vec3bArray"}) {
    EXPECT_EQ(xs_of("Geode {\nnum_drawables 1\nGeometry {\nPrimitives 1\n{\nDrawArrays TRIANGLES 0 3\n}\nVertexArray " +
                    std::string(kind) + " 3\n{\n-100 0 0\n0 1 0\n0 0 1\n}\n}\n}\n"),
              (std::vector<double>{-100}))
        << kind;
  }
}

TEST(ImportSceneGraph, NamesPrimitivesWhoseTrianglesShadersMake) {
  const TemporaryFolder folder;
  const ImportedScene scene = import_scene(
      folder.write("patches.osg",
                   "Geode {\nnum_drawables 1\nGeometry {\nPrimitives 2\n{\nDrawArrays TRIANGLES 0 3\nDrawArrays "
                   "PATCHES 0 3\n}\nVertexArray Vec3Array 3\n{\n0 0 0\n1 0 0\n0 1 0\n}\n}\n}\n"));
  EXPECT_EQ(scene.report.triangles, 1u);
  EXPECT_TRUE(notes_contain(scene, "patches, and triangles with neighbours, in an osg::Geometry"));
}

TEST(ImportSceneGraph, LeavesOutTrianglesWhoseIndicesLeadNowhere) {
  const TemporaryFolder folder;
  const ImportedScene scene =
      import_scene(folder.write("indices.osg",
                                "Geode {\nname \"Broken\"\nnum_drawables 1\nGeometry {\nPrimitives 1\n{\n"
                                "DrawElementsUInt TRIANGLES 6 {\n0 1 2 0 1 70000\n}\n}\nVertexArray Vec3Array 3\n{\n"
                                "0 0 0\n1 0 0\n0 1 0\n}\n}\n}\n"));
  EXPECT_EQ(scene.report.triangles, 1u);
  EXPECT_EQ(scene.report.bad_triangles, 1u);
  ASSERT_EQ(scene.report.bad_objects.size(), 1u);
  EXPECT_EQ(scene.report.bad_objects[0].name, "Broken");
}

TEST(ImportSceneGraph, NamesObjectsByTheNearestNameAndIgnoresByAnyAncestor) {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "names.osg", group("Group", "name \"House\"\n",
                         {group("Group", "name \"Doors\"\n", {triangle_at("1"), triangle_at("2", "Door_7")}),
                          triangle_at("3", "Wall"), triangle_at("4", "Tree 12")}));
  const ImportedScene all = import_scene(file);
  ASSERT_EQ(all.meshes.size(), 4u);
  EXPECT_EQ(all.meshes[0].name, "Doors");
  EXPECT_EQ(all.meshes[1].name, "Door_7");
  const ImportedScene some = import_scene(file, {.ignore = {"Doors", "Tree*", "Window?"}});
  EXPECT_EQ(first_xs(some), (std::vector<double>{3}));
  EXPECT_EQ(some.report.ignored_triangles, 3u);
  EXPECT_EQ(some.report.ignored_objects.size(), 3u);
  EXPECT_TRUE(notes_contain(some, "No object's name matches 'Window?'"));
  EXPECT_TRUE(contains(import_error(file, {.ignore = {"House"}}), "all of its 4 triangles are in objects"));
}

std::string paged(const std::string& coarse, const std::vector<std::string>& files) {
  std::string ranges = "0 100\n", names = "\"\"\n";
  for (const std::string& file : files) {
    ranges += "100 1e30\n";
    names += file + "\n";
  }
  const std::string count = std::to_string(files.size() + 1);
  return group("PagedLOD",
               "RangeMode PIXEL_SIZE_ON_SCREEN\nRangeList " + count + " {\n" + ranges + "}\nFileNameList " + count +
                   " {\n" + names + "}\n",
               {coarse});
}

TEST(ImportSceneGraph, LoadsPagesDownToTheFinest) {
  const TemporaryFolder folder;
  folder.write("middle/page1.osg", paged(triangle_at("2"), {"fine/page2.osg"}));
  folder.write("middle/fine/page2.osg", triangle_at("3"));
  const ImportedScene scene =
      import_scene(folder.write("root.osg", moved("10", {paged(triangle_at("1"), {"middle/page1.osg"})})));
  EXPECT_EQ(first_xs(scene), (std::vector<double>{13}));
  EXPECT_EQ(scene.report.files, 3u);
  EXPECT_EQ(scene.meshes[0].name, "page2");
}

TEST(ImportSceneGraph, FallsBackToTheCoarserLevelWhereAPageIsMissing) {
  const TemporaryFolder folder;
  folder.write("here.osg", triangle_at("5"));
  folder.write("broken.osg", "Group {\n");
  const ImportedScene scene = import_scene(
      folder.write("root.osg", group("Group", "",
                                     {paged(triangle_at("1"), {"gone.osg"}), paged(triangle_at("2"), {"here.osg"}),
                                      paged(triangle_at("3"), {"here.osg", "gone.osg"})})));
  // Where one of two pages is missing the other alone would leave a hole.
  EXPECT_EQ(first_xs(scene), (std::vector<double>{1, 5, 3}));
  EXPECT_EQ(scene.report.missing_pages, 2u);
  ASSERT_EQ(scene.report.missing_page_files.size(), 2u);
  EXPECT_TRUE(contains(scene.report.missing_page_files[0], "gone.osg"));
  EXPECT_TRUE(notes_contain(scene, "2 files that the scene refers to are absent"));
}

TEST(ImportSceneGraph, EndsPagesThatReferToThemselves) {
  const TemporaryFolder folder;
  const ImportedScene scene = import_scene(folder.write("loop.osg", paged(triangle_at("1"), {"./x/../loop.osg"})));
  EXPECT_EQ(first_xs(scene), (std::vector<double>{1}));
  EXPECT_EQ(scene.report.missing_pages, 1u);
}

std::string proxy(const std::string& file, const std::string& mode = "LOAD_IMMEDIATELY") {
  return "ProxyNode {\nExtRefMode " + mode + "\nFileNameList 1 {\n\"" + file + "\"\n}\nnum_children 0\n}\n";
}

std::string level(const std::string& range, const std::vector<std::string>& children) {
  return group("LOD", "RangeList 1 {\n" + range + "\n}\n", {group("Group", "", children)});
}

TEST(ImportSceneGraph, ReadsProxiesAndCountsThoseThatAreMissing) {
  const TemporaryFolder folder;
  folder.write("part.osg", triangle_at("7"));
  const ImportedScene scene = import_scene(folder.write(
      "root.osg", group("Group", "", {proxy("part.osg"), proxy("gone.osg"), proxy("http://localhost/a.osg")})));
  EXPECT_EQ(first_xs(scene), (std::vector<double>{7}));
  EXPECT_EQ(scene.report.missing_pages, 2u);
}

TEST(ImportSceneGraph, ReadsProxiesThatOpenSceneGraphLoadsWhileItDraws) {
  const TemporaryFolder folder;
  const auto deferred = [](const std::string& file) { return proxy(file, "DEFER_LOADING_TO_DATABASE_PAGER"); };
  folder.write("parts/wall.osg", triangle_at("8"));
  folder.write("parts/house.osg", group("Group", "", {triangle_at("7"), deferred("wall.osg"), deferred("gone.osg")}));
  const ImportedScene scene = import_scene(
      folder.write("root.osg", group("Group", "",
                                     {moved("10", {deferred("parts/house.osg")}), proxy("parts/house.osg"),
                                      deferred("root.osg"), proxy("parts/wall.osg", "NO_AUTOMATIC_LOADING")})));
  EXPECT_EQ(first_xs(scene), (std::vector<double>{17, 18, 7, 8}));
  EXPECT_EQ(scene.report.missing_pages, 3u);
}

TEST(ImportSceneGraph, ReadsProxiesFromTheirDatabasePath) {
  const TemporaryFolder folder;
  folder.write("parts/wall.osg", triangle_at("8"));
  folder.write("roof.osg", triangle_at("9"));
  std::string text =
      "#Ascii Scene\n#Version 161\n#Generator OpenSceneGraph 3.6.5\n\nosg::Group {\n UniqueID 1\n Children 4 {\n";
  int id = 1;
  const auto add = [&](const std::string& path, const std::string& file) {
    text += "  osg::ProxyNode {\n   UniqueID " + std::to_string(++id) + "\n   FileNames 1 {\n    \"" + file +
            "\"\n   }\n   DatabasePath \"" + path +
            "\"\n   LoadingExternalReferenceMode DEFER_LOADING_TO_DATABASE_PAGER\n  }\n";
  };
  add("parts/", "wall.osg");
  add((folder.path() / "parts").string(), "wall.osg");
  add("parts/", "roof.osg");
  add("/etc/", "outside.osg");
  EXPECT_EQ(first_xs(import_scene(folder.write("root.osgt", text + " }\n}\n"))), (std::vector<double>{8, 8, 9}));
}

TEST(ImportSceneGraph, FallsBackToTheCoarserLevelWhereAProxyIsMissing) {
  const std::vector<std::string> fine{triangle_at("1"), proxy("gone.osg")};
  const auto lod = [&](const std::vector<std::string>& coarse) {
    return group("LOD", "RangeList 2 {\n0 100\n100 500\n}\n", {group("Group", "", fine), group("Group", "", coarse)});
  };
  EXPECT_EQ(xs_of(lod({triangle_at("2")})), (std::vector<double>{2}));
  // No level is whole.
  EXPECT_EQ(xs_of(lod({triangle_at("2"), proxy("gone.osg")})), (std::vector<double>{1}));
  EXPECT_EQ(xs_of(level("0 100", fine)), (std::vector<double>{1}));
  // A level of detail below replaces it.
  EXPECT_EQ(xs_of(group("LOD", "RangeList 2 {\n0 100\n100 500\n}\n", {lod({triangle_at("2")}), triangle_at("3")})),
            (std::vector<double>{2}));
}

TEST(ImportSceneGraph, FallsBackToTheSiblingThatIsACoarserLevel) {
  const std::string fine = level("0 100", {triangle_at("1"), proxy("gone.osg")});
  const std::string coarse = level("100 500", {triangle_at("2")}), far = level("500 900", {triangle_at("3")});
  EXPECT_EQ(xs_of(group("Group", "", {fine, coarse, far})), (std::vector<double>{2}));
  EXPECT_EQ(xs_of(group("Group", "", {far, coarse, fine})), (std::vector<double>{2}));
  const std::string gone = level("100 500", {proxy("gone.osg")});
  EXPECT_EQ(xs_of(group("Group", "", {fine, gone, far})), (std::vector<double>{3}));
  EXPECT_EQ(xs_of(group("Group", "", {level("0 100", {triangle_at("1")}), gone, far})), (std::vector<double>{1}));
  EXPECT_EQ(
      xs_of(group("Group", "",
                  {group("PagedLOD", "RangeList 1 {\n0 100\n}\nFileNameList 1 {\n\"gone.osg\"\n}\n", {}), coarse})),
      (std::vector<double>{2}));
}

TEST(ImportSceneGraph, LosesNothingWhereASiblingHasHoles) {
  const TemporaryFolder folder;
  folder.write("part.osg", group("Group", "", {triangle_at("1"), proxy("gone.osg")}));
  folder.write("damaged.osgt", "#Ascii Scene\n");
  const auto page = [](const std::string& range, const std::string& file) {
    return group("PagedLOD", "RangeList 1 {\n" + range + "\n}\nFileNameList 1 {\n\"" + file + "\"\n}\n", {});
  };
  const auto read = [&](const std::vector<std::string>& levels, const std::string& kind = "Group",
                        const std::string& fields = "") {
    return import_scene(folder.write("root.osg", group(kind, fields, levels)));
  };
  const auto hidden = [](std::string lod) { return lod.insert(lod.find("RangeList"), "nodeMask 0x0\n"); };
  using Xs = std::vector<double>;
  const std::string fine = level("0 100", {triangle_at("1"), proxy("gone.osg")});
  const std::string coarse = level("100 500", {triangle_at("2")}), gone = level("100 500", {proxy("gone.osg")});

  const ImportedScene part = read({coarse, page("0 100", "part.osg")});
  EXPECT_EQ(first_xs(part), Xs{2});
  EXPECT_EQ(part.report.missing_pages, 1u);
  EXPECT_EQ(first_xs(read({page("0 100", "damaged.osgt"), coarse})), Xs{2});
  // A coarser level that is not whole itself, or not shown, fills no hole.
  EXPECT_EQ(first_xs(read({page("0 100", "part.osg"), page("100 500", "gone.osg")})), Xs{1});
  EXPECT_EQ(first_xs(read({fine, page("100 500", "gone.osg")})), Xs{1});
  EXPECT_EQ(first_xs(read({fine, gone})), Xs{1});
  EXPECT_EQ(first_xs(read({fine, coarse, gone})), (Xs{1, 2}));
  EXPECT_EQ(first_xs(read({fine, hidden(coarse)})), Xs{1});
  EXPECT_EQ(first_xs(read({fine, coarse}, "Switch", "NewChildDefaultValue TRUE\nValueList {\n1\n0\n}\n")), Xs{1});
  EXPECT_EQ(first_xs(read({fine, coarse}, "LOD", "RangeList 2 {\n0 100\n100 500\n}\n")), Xs{1});
  // A finer one that is not shown replaces nothing.
  EXPECT_EQ(first_xs(read({hidden(level("0 100", {triangle_at("1")})), coarse})), Xs{2});
}

TEST(ImportSceneGraph, ReadsFarOffObjectsThatContinueNoSibling) {
  EXPECT_EQ(xs_of(group("Group", "",
                        {level("0 100", {triangle_at("1")}), moved("999", {triangle_at("2")}),
                         level("100 500", {moved("999", {triangle_at("3")})})})),
            (std::vector<double>{1, 1001, 1002}));
}

std::string metadata(const std::string& srs, const std::string& origin) {
  return "<?xml version=\"1.0\"?>\n<ModelMetadata version=\"1\"><SRS>" + srs + "</SRS><SRSOrigin>" + origin +
         "</SRSOrigin></ModelMetadata>\n";
}

/// A chunk of a 3DS file.
std::string chunk(std::uint16_t id, const std::string& content) {
  return bytes_of(id) + bytes_of(static_cast<std::uint32_t>(content.size() + 6)) + content;
}

TEST(ImportSceneGraph, Reads3dsWithItsNumbers) {
  std::string vertices = bytes_of(std::uint16_t{3}), faces = bytes_of(std::uint16_t{1});
  for (const float c : {1.f, 2.f, 3.f, 4.f, 5.f, 6.f, 7.f, 9.f, 8.f}) vertices += bytes_of(c);
  for (const std::uint16_t i : {0, 1, 2, 0}) faces += bytes_of(i);
  const std::string mesh = chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4120, faces));
  const std::string object = chunk(0x4000, std::string("Ramp") + '\0' + mesh);
  const TemporaryFolder folder;
  const ImportedScene scene = import_scene(
      folder.write("ramp.3ds", chunk(0x4d4d, chunk(0x0002, bytes_of(std::uint32_t{3})) + chunk(0x3d3d, object))));
  ASSERT_EQ(scene.report.triangles, 1u);
  EXPECT_EQ(scene.meshes[0].name, "Ramp");
  EXPECT_EQ(triangles_of(scene)[0], (Triangle{Vec3(1, 2, 3), Vec3(4, 5, 6), Vec3(7, 9, 8)}));
}

TEST(ImportSceneGraph, ReadsAc3dWithItsNumbers) {
  const TemporaryFolder folder;
  const ImportedScene scene = import_scene(folder.write(
      "ramp.ac",
      "AC3Db\nMATERIAL \"White\" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 64 trans 0\nOBJECT world\nkids 1\n"
      "OBJECT poly\nname \"Ramp\"\nloc 10 0 0\nnumvert 4\n1 2 3\n4 5 6\n7 9 8\n1 9 8\nnumsurf 1\nSURF 0x20\nmat 0\n"
      "refs 4\n0 0 0\n1 1 0\n2 1 1\n3 1 1\nkids 0\n"));
  ASSERT_EQ(scene.report.triangles, 2u);
  EXPECT_EQ(scene.meshes[0].name, "Ramp");
  EXPECT_EQ(triangles_of(scene)[0][0], Vec3(11, 2, 3));
}

TEST(ImportSceneGraph, ReadsDxfFacesWithTheirNumbers) {
  std::string face = "0\nSECTION\n2\nENTITIES\n0\n3DFACE\n8\nRamp\n";
  const char* codes[] = {"10", "20", "30", "11", "21", "31", "12", "22", "32", "13", "23", "33"};
  const char* values[] = {"1", "2", "3", "4", "5", "6", "7", "9", "8", "1", "9", "8"};
  for (int i = 0; i < 12; ++i) face += std::string(codes[i]) + "\n" + values[i] + "\n";
  const TemporaryFolder folder;
  const ImportedScene scene = import_scene(folder.write("ramp.dxf", face + "0\nENDSEC\n0\nEOF\n"));
  EXPECT_EQ(scene.report.triangles, 2u);
  EXPECT_EQ(bounds_of(scene).lower, Vec3(1, 2, 3));
  EXPECT_EQ(bounds_of(scene).upper, Vec3(7, 9, 8));
}

/// A tile of one triangle with a corner at (x, 0, 0): the reader of .osgb knows its text form by its first word.
std::string tile(const std::string& x) {
  return "#Ascii Scene\n#Version 161\n#Generator OpenSceneGraph 3.6.5\n\nosg::Geode {\n UniqueID 1\n Drawables 1 {\n  "
         "osg::Geometry {\n"
         "   UniqueID 2\n   PrimitiveSetList 1 {\n    osg::DrawArrays {\n     UniqueID 3\n     Mode TRIANGLES\n"
         "     Count 3\n    }\n   }\n   VertexArray TRUE {\n    osg::Vec3Array {\n     UniqueID 4\n"
         "     Binding BIND_PER_VERTEX\n     vector 3 {\n      " +
         x + " 0 0\n      0 1 0\n      0 0 1\n     }\n    }\n   }\n  }\n }\n}\n";
}

TEST(ImportSceneGraph, ReadsFoldersOfTilesInTheOrderOfTheirNames) {
  const TemporaryFolder folder;
  folder.write("a/Data/Tile_+001_+000/Tile_+001_+000.osgb", tile("2"));
  folder.write("a/Data/Tile_+000_+001/Tile_+000_+001.osgb", tile("1"));
  folder.write("a/Data/Tile_+000_+001/Tile_+000_+001_L20.osgb", tile("9"));
  folder.write("a/Data/Tile_+002_+000/not the tile.txt", "");
  folder.write("a/Data/Thumbs/x.osgb", "");
  for (const char* path : {"a", "a/", "a/Data", "a/Data/"}) {
    const ImportedScene scene = import_scene(folder.path() / path);
    EXPECT_EQ(first_xs(scene), (std::vector<double>{1, 2})) << path;
    EXPECT_EQ(scene.meshes[0].name, "Tile_+000_+001");
    EXPECT_EQ(scene.report.missing_pages, 1u);
    EXPECT_FALSE(scene.report.georeference);
  }
  EXPECT_EQ(first_xs(import_scene(folder.path() / "a/Data/Tile_+001_+000")), (std::vector<double>{2}));
}

TEST(ImportSceneGraph, RefusesAFolderWithoutTiles) {
  const TemporaryFolder folder;
  folder.write("a/Data/Tile_3/readme.txt", "");
  EXPECT_TRUE(contains(import_error(folder.path() / "a"), "holds no Data/Tile_*/Tile_*.osgb"));
  EXPECT_TRUE(contains(import_error(folder.path()), "holds no Data/Tile_*/Tile_*.osgb"));
  folder.write("b/Data/Tile_4/Tile_4.osgb", "garbage");
  EXPECT_TRUE(contains(import_error(folder.path() / "b"), "this gives no triangle"));
}

TEST(ImportSceneGraph, PlacesFoldersRelativeToTheFirstByTheirOrigins) {
  const TemporaryFolder folder;
  const auto scene_folder = [&](const std::string& name, const std::string& x, const std::string& srs,
                                const std::string& origin) {
    folder.write(name + "/Data/Tile_1/Tile_1.osgb", tile(x));
    if (!origin.empty()) folder.write(name + "/metadata.xml", metadata(srs, origin));
    return folder.path() / name;
  };
  const auto first = scene_folder("first", "1", "EPSG:32632", "500000.5,5000000,100");
  const auto second = scene_folder("second", "1", "EPSG:32632", " 500300.25 , 5000000 , 90 ");
  const auto elsewhere = scene_folder("elsewhere", "1", "EPSG:4326", "8,47,0");
  const auto nowhere = scene_folder("nowhere", "5", "", "");
  const auto broken = scene_folder("broken", "6", "EPSG:32632", "1,2");

  const ImportedScene one = import_scene(second);
  EXPECT_EQ(first_xs(one), (std::vector<double>{1}));
  ASSERT_TRUE(one.report.georeference);
  EXPECT_EQ(one.report.georeference->origin, Vec3(500300.25, 5000000, 90));
  EXPECT_TRUE(notes_contain(one, "in 'EPSG:32632' the scene's zero lies at (500300.25, 5000000, 90)"));

  const std::vector<std::filesystem::path> both{first, second, nowhere};
  const ImportedScene merged = import_scene(both);
  EXPECT_EQ(first_xs(merged), (std::vector<double>{1, 300.75, 5}));
  EXPECT_EQ(triangles_of(merged)[1][1], Vec3(299.75, 1, -10));
  EXPECT_EQ(merged.report.georeference->origin, Vec3(500000.5, 5000000, 100));
  EXPECT_TRUE(notes_contain(merged, "are moved by (299.75, 0, -10)"));
  EXPECT_TRUE(notes_contain(merged, "its place relative to the folders before is not known"));

  const std::vector<std::filesystem::path> apart{first, elsewhere};
  EXPECT_THROW(static_cast<void>(import_scene(apart)), Error);
  EXPECT_TRUE(notes_contain(import_scene(broken), "holds no SRSOrigin of three numbers"));

  const auto defined = scene_folder("defined", "1", "PROJCS[\"Grid A\",\n GEOGCS[\"G\", DATUM[\"D\"]]]", "1,2,3");
  EXPECT_TRUE(notes_contain(import_scene(defined), "in 'Grid A' the scene's zero lies at (1, 2, 3)"));
  EXPECT_TRUE(import_scene(defined).report.georeference->srs.ends_with("DATUM[\"D\"]]]"));
}

}  // namespace
}  // namespace roam::test
