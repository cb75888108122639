// What is to be seen is what is walked on: triangles, places, pages, errors. Looks are in import_display_looks.cpp.

#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "import/page_reader.h"
#include "shown_scene.h"

namespace roam::test {
namespace {

using Paths = std::vector<std::filesystem::path>;

/// A scene of each family of readers, its geometry near (x, 0, 0).
std::map<std::string, std::string> scenes_at(const std::string& x) {
  const std::string obj = "v " + x + ".0123456 1 2\nv " + x + ".75 3 4\nv " + x + ".5 9 7.000001\nv " + x +
                          ".25 0 1\no Wall\nf 1 2 3\ng Door\nf 1 2 3 4\n";
  const std::string stl = "solid Wall\nfacet normal 0 0 1\nouter loop\nvertex " + x + ".0123456 1 2\nvertex " + x +
                          ".75 3 4\nvertex " + x + ".5 9 7\nendloop\nendfacet\nendsolid Wall\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty "
      "double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n" +
      x + ".0123456 1 2\n" + x + ".75 3 4\n" + x + ".5 9 7\n" + x + ".25 0 1\n4 0 1 2 3\n";
  const std::string geode =
      "Geode {\nUniqueID shared\nnum_drawables 1\nGeometry {\nPrimitives 2\n{\nDrawArrays TRIANGLE_STRIP 0 "
      "4\nDrawElementsUByte QUADS 4 {\n3 2 1 0\n}\n}\nVertexArray Vec3dArray 4\n{\n0.0123456 0 0\n0 1 0\n0 0 1\n2 1 "
      "3\n}\n}\n}\n";
  const auto moved = [](const std::string& matrix, const std::string& child) {
    return "MatrixTransform {\nMatrix {\n" + matrix + "\n}\nnum_children 1\n" + child + "}\n";
  };
  const std::string osg = "Group {\nnum_children 3\n" + moved("1 0 0 0\n0 1 0 0\n0 0 1 0\n" + x + " 0 0 1", geode) +
                          moved("0 2 0 0\n-2 0 0 0\n0 0 -2 0\n" + x + ".5 7 8 1", "Use shared\n") +
                          "Switch {\nNewChildDefaultValue TRUE\nValueList {\n0\n}\nnum_children 1\nUse shared\n}\n}\n";
  const std::string off = "OFF\n4 1 0\n" + x + " 1 2\n" + x + " 3 4\n" + x + " 9 7\n" + x + " 0 1\n4 0 1 2 3\n";
  return {{"scene.obj", obj}, {"scene.stl", stl}, {"scene.ply", ply}, {"scene.osg", osg}, {"scene.off", off}};
}

TEST(ImportDisplay, ShowsTheTrianglesThatAreWalkedOn) {
  const TemporaryFolder folder;
  for (const auto& [name, content] : scenes_at("12")) {
    const auto file = folder.write(name, content);
    for (const ImportOptions& options : {ImportOptions{}, ImportOptions{.up = UpAxis::y, .unit = LengthUnit::ft},
                                         ImportOptions{.up = UpAxis::x}, ImportOptions{.up = UpAxis::minus_y}}) {
      const ImportedScene scene = import_scene(file, options);
      const Shown shown = show({file}, options);
      EXPECT_GT(shown.triangles.size(), 0u) << name;
      EXPECT_EQ(not_shown(scene, shown, 2e-6), 0u) << name;
      EXPECT_EQ(shown.report.triangles, scene.report.triangles) << name;
      EXPECT_EQ(shown.report.origin, Vec3(0.0)) << name;
      const Box box = bounds_of(scene);
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(shown.report.bounds.lower[k], box.lower[k], 1e-5) << name;
        EXPECT_NEAR(shown.report.bounds.upper[k], box.upper[k], 1e-5) << name;
      }
    }
  }
}

TEST(ImportDisplay, KeepsMicrometresFarFromZero) {
  const TemporaryFolder folder;
  for (const auto& [name, content] : scenes_at("6400000")) {
    const auto file = folder.write(name, content);
    const Shown shown = show({file});
    EXPECT_EQ(not_shown(import_scene(file), shown, 2e-5), 0u) << name;
    EXPECT_EQ(shown.report.origin, Vec3(6400000, 0, 0)) << name;
    for (const DisplayGeometry* geometry : shown.geometries()) {
      for (const glm::vec3& place : geometry->positions) EXPECT_LT(glm::length(place), 1000.0f) << name;
    }
  }
}

TEST(ImportDisplay, PutsAllPathsIntoOneFrame) {
  const TemporaryFolder folder;
  const auto near = folder.write("near.obj", scenes_at("12")["scene.obj"]);
  const auto far = folder.write("far.obj", scenes_at("6400000")["scene.obj"]);
  for (const Paths& paths : {Paths{near, far}, Paths{far, near}}) {
    const Shown shown = show(paths);
    EXPECT_EQ(shown.report.origin, paths[0] == near ? Vec3(0.0) : Vec3(6400000, 0, 0));
    for (const auto& part : shown.parts) EXPECT_EQ(part->origin, shown.report.origin);
    EXPECT_EQ(not_shown(import_scene(paths), shown, 2e-5), 0u);
  }
}

TEST(ImportDisplay, LeavesOutWhatIsIgnoredOrDamaged) {
  const TemporaryFolder folder;
  const auto file = folder.write("scene.obj", scenes_at("1")["scene.obj"] + "v nan 0 0\no Broken\nf 1 2 5\n");
  const ImportOptions options{.ignore = {"Door", "Window"}};
  const Shown shown = show({file}, options);
  EXPECT_EQ(shown.triangles.size(), 1u);
  EXPECT_EQ(shown.report.import.ignored_triangles, 2u);
  EXPECT_EQ(shown.report.import.bad_triangles, 1u);
  EXPECT_EQ(shown.report.import.notes, import_scene(file, options).report.notes);
}

/// A bumpy square of n by n quads, each 1 m wide, as binary PLY.
std::string plane(std::uint32_t n) {
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string((n + 1) * (n + 1)) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(n * n) +
                     "\nproperty list uchar uint vertex_indices\nend_header\n";
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) {
      for (const float c : {float(i), float(j), float((i * 7 + j * 3) % 5)}) text += bytes_of(c);
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t v = i * (n + 1) + j;
      text += '\4';
      for (const std::uint32_t corner : {v, v + 1, v + n + 2, v + n + 1}) text += bytes_of(corner);
    }
  }
  return text;
}

/// "Wall 1" of each object: its names, with > between them, and its triangles.
std::string objects_of(const Shown& shown) {
  std::map<std::string, std::uint32_t> counts;
  for (const auto& part : shown.parts) {
    for (const DisplayGeometry& geometry : part->geometries) {
      std::uint32_t all = 0;
      for (const DisplayRun& run : geometry.runs) {
        std::string name = part->objects.at(run.object);
        std::replace(name.begin(), name.end(), DisplayPart::name_separator, '>');
        counts[name] += run.triangles;
        all += run.triangles;
      }
      EXPECT_EQ(3 * all, geometry.indices.size());
    }
  }
  std::string text;
  for (const auto& [name, count] : counts) text += (text.empty() ? "" : "; ") + name + " " + std::to_string(count);
  return text;
}

TEST(ImportDisplay, SaysWhichObjectATriangleIsOf) {
  const TemporaryFolder folder;
  EXPECT_EQ(objects_of(show({folder.write("scene.obj", scenes_at("1")["scene.obj"])})), "Wall 1; Wall>Door 2");
  EXPECT_EQ(objects_of(show({folder.write("house.ply", scenes_at("1")["scene.ply"])})), "house 2");
  const auto named = [](const std::string& name, const std::string& child) {
    return "Group {\nname \"" + name + "\"\nnum_children 1\n" + child + "}\n";
  };
  const std::string geode =
      "Geode {\nname \"Table\"\nnum_drawables 1\nGeometry {\nPrimitives 1\n{\nDrawArrays TRIANGLES 0 "
      "3\n}\nVertexArray Vec3dArray 3\n{\n0 0 0\n0 1 0\n0 0 1\n}\n}\n}\n";
  EXPECT_EQ(objects_of(show({folder.write("house.osg", named("House", named("Kitchen", geode)))})),
            "House>Kitchen>Table 1");
  // Triangles of one object follow each other, however many there are of them.
  const Shown many = show({folder.write("plane.ply", plane(300))});
  for (const DisplayGeometry* geometry : many.geometries()) {
    EXPECT_EQ(geometry->runs.size(), 1u);
  }
}

TEST(ImportDisplay, CutsLargeGeometryIntoChunksAndParts) {
  const TemporaryFolder folder;
  const auto file = folder.write("plane.ply", plane(600));
  const Shown shown = show({file});
  EXPECT_EQ(not_shown(import_scene(file), shown, 2e-5), 0u);
  EXPECT_GE(shown.parts.size(), 3u);
  EXPECT_LE(shown.geometries().size(), 200u);
  for (const DisplayGeometry* geometry : shown.geometries()) {
    EXPECT_LE(geometry->indices.size(), 3 * 16384u);
    Box box;
    for (const glm::vec3& place : geometry->positions) box.include(Vec3(place));
    // A part is at worst a strip across the square, and its chunks are pieces of it.
    EXPECT_LT(box.size().x * box.size().y, 40000.0);
  }
}

TEST(ImportDisplay, SaysTheSameErrorsAsImporting) {
  const TemporaryFolder folder;
  const Paths paths{folder.path() / "gone.obj",
                    folder.write("bad.obj", "v 1 2\n"),
                    folder.write("bad.ply", "ply\nformat ascii 1.0\n"),
                    folder.write("points.obj", "v 1 2 3\nv 2 3 4\np 1 2\n"),
                    folder.write("bad.osgb", "garbage"),
                    folder.write("bad.glb", "garbage"),
                    folder.write("scene.las", "garbage"),
                    folder.path()};
  for (const auto& path : paths) {
    EXPECT_NE(display_error(path), "") << path;
    EXPECT_EQ(display_error(path), import_error(path)) << path;
  }
  const auto good = folder.write("good.obj", scenes_at("1")["scene.obj"]);
  EXPECT_EQ(display_error(good, {.ignore = {"*"}}), import_error(good, {.ignore = {"*"}}));
}

TEST(ImportDisplay, EndsTheReaderWhenNobodyWantsMore) {
  const TemporaryFolder folder;
  const Paths paths{folder.write("plane.ply", plane(600))};
  int parts = 0;
  EXPECT_THROW(read_display(paths, {}, [&](DisplayPart&&) { return ++parts < 2; }), Cancelled);
  EXPECT_EQ(parts, 2);
  ImportOptions options;
  options.progress = [](const ImportProgress&) { return false; };
  EXPECT_THROW(read_display(paths, options, [](DisplayPart&&) { return true; }), Cancelled);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

/// A tile whose page is in another file.
std::string paged_tile(const std::string& x, const std::string& page) {
  return "#Ascii Scene\n#Version 161\n#Generator OpenSceneGraph 3.6.5\n\nosg::PagedLOD {\n UniqueID 1\n RangeMode "
         "PIXEL_SIZE_ON_SCREEN\n RangeList 2 {\n  0 100\n  100 1e+30\n }\n DatabasePath FALSE\n RangeDataList 2 {\n  "
         "\"\"\n  \"" +
         page +
         "\"\n }\n PriorityList 2 {\n  0 1\n  0 1\n }\n Children 1 {\n  osg::Geode {\n UniqueID 5\n Drawables 1 {\n  "
         "osg::Geometry {\n   UniqueID 2\n   PrimitiveSetList 1 {\n    osg::DrawArrays {\n     UniqueID 3\n     Mode "
         "TRIANGLES\n     Count 3\n    }\n   }\n   VertexArray TRUE {\n    osg::Vec3Array {\n     UniqueID 4\n     "
         "Binding BIND_PER_VERTEX\n     vector 3 {\n      " +
         x + " 0 0\n      " + x + " 2 0\n      " + x + " 0 4\n     }\n    }\n   }\n  }\n }\n}\n }\n}\n";
}

TEST(ImportDisplay, HandsOnPagesUnread) {
  const TemporaryFolder folder;
  folder.write("a/Data/Tile_1/Tile_1.osgb", paged_tile("10", "fine.osgb"));
  folder.write("a/Data/Tile_1/fine.osgb", paged_tile("10", ""));
  folder.write("a/Data/Tile_2/Tile_2.osgb", paged_tile("20", "gone.osgb"));
  folder.write("a/Data/Tile_3/Tile_3.osgb", "garbage");
  const auto tiles = folder.path() / "a";
  const Shown shown = show({tiles}, {.up = UpAxis::y, .ignore = {"Tree"}});
  EXPECT_TRUE(shown.report.paged);
  const auto pages = shown.pages();
  ASSERT_EQ(pages.size(), 1u);
  ASSERT_EQ(pages[0]->levels.size(), 1u);
  EXPECT_TRUE(contains(pages[0]->levels[0].page, (tiles / "Data/Tile_1/Tile_1.osgb").string()));
  EXPECT_EQ(pages[0]->levels[0].from, 0.0f);
  EXPECT_GT(pages[0]->levels[0].to, 1e30f);
  EXPECT_LT(glm::length(pages[0]->center - Vec3(10, -2, 1)), 1e-5);
  EXPECT_GE(pages[0]->radius, std::sqrt(5.0f));
  // The tile whose only page is missing is shown as it is, and the broken one is told.
  ASSERT_EQ(shown.triangles.size(), 1u);
  EXPECT_EQ(shown.triangles[0].corners, (Triangle{Vec3(20, 0, 0), Vec3(20, 0, 2), Vec3(20, -4, 0)}));
  EXPECT_EQ(shown.report.import.missing_pages, 2u);
  EXPECT_EQ(shown.report.bounds.lower, Vec3(10, -4, 0));
  EXPECT_EQ(shown.report.bounds.upper, Vec3(20, 0, 2));
  // What a pattern matches in pages is not known yet.
  EXPECT_TRUE(shown.report.notes.empty());
  for (const std::string& note : shown.report.import.notes) EXPECT_FALSE(contains(note, "Tree")) << note;

  const Shown of_file = show({tiles / "Data/Tile_1/Tile_1.osgb"});
  ASSERT_EQ(of_file.pages().size(), 1u);
  EXPECT_EQ(of_file.pages()[0]->levels[0].page, pages[0]->levels[0].page);
}

TEST(ImportDisplay, PlacesPagedFoldersByTheirOrigins) {
  const TemporaryFolder folder;
  Paths paths;
  for (const auto& [name, origin] : {std::pair("a", "500000,5000000,0"), std::pair("b", "500100,5000200,5")}) {
    folder.write(std::string(name) + "/Data/Tile_1/Tile_1.osgb", paged_tile("30000", "fine.osgb"));
    folder.write(std::string(name) + "/Data/Tile_1/fine.osgb", paged_tile("30000", ""));
    folder.write(std::string(name) + "/metadata.xml", "<ModelMetadata><SRS>EPSG:32632</SRS><SRSOrigin>" +
                                                          std::string(origin) + "</SRSOrigin></ModelMetadata>");
    paths.push_back(folder.path() / name);
  }
  const Shown shown = show(paths);
  EXPECT_EQ(shown.report.origin, Vec3(30000, 0, 0));
  const auto pages = shown.pages();
  ASSERT_EQ(pages.size(), 2u);
  EXPECT_EQ(pages[1]->center - pages[0]->center, Vec3(100, 200, 5));
  // What is in the pages lies there, too.
  PageReader reader(paths, {});
  for (std::uint32_t source = 0; source < 2; ++source) {
    const DisplayPart page = reader.read(source, shown.report.origin, pages[source]->levels[0].page);
    const auto triangles = triangles_of(page);
    ASSERT_EQ(triangles.size(), 1u);
    EXPECT_EQ(triangles[0].corners[0], Vec3(30000, 0, 0) + double(source) * Vec3(100, 200, 5));
  }
}

}  // namespace
}  // namespace roam::test
