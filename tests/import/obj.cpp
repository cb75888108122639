// Wavefront OBJ: what its readers are known to get wrong, and every digit.

#include <gtest/gtest.h>

#include <string>

#include "import_files.h"

namespace roam::test {
namespace {

TEST(ImportObj, KeepsEveryDigitFarFromTheOrigin) {
  const TemporaryFolder folder;
  const ImportedScene scene = import_scene(folder.write("far.obj",
                                                        "v 4012345.678901234 -0.1 1e-300\n"
                                                        "v +4012346.678901234 .5 -7.25E+2\n"
                                                        "v 3 4 5\n"
                                                        "f 1 3 3\n"));
  EXPECT_EQ(triangles_of(scene)[0][0], Vec3(4012345.678901234, -0.1, 1e-300));
}

TEST(ImportObj, ReadsTheNearestDoubleOfLongDigitStrings) {
  const TemporaryFolder folder;
  // Halfway cases that readers with powers of ten in floating point get wrong.
  const ImportedScene scene = import_scene(folder.write("digits.obj",
                                                        "v 9007199.254740993 0.1000000000000000055511151231257827 1\n"
                                                        "v 1 +2.5 .25\nv 0 -0 5.\nf 1 2 3\n"));
  const Triangle t = triangles_of(scene)[0];
  EXPECT_EQ(t[0], Vec3(9007199.254740993, 0.1, 1));
  EXPECT_EQ(t[1], Vec3(1, 2.5, 0.25));
  EXPECT_EQ(t[2], Vec3(0, 0, 5));
}

TEST(ImportObj, UnderstandsNegativeIndicesAndAllCornerForms) {
  const TemporaryFolder folder;
  const ImportedScene scene =
      import_scene(folder.write("corners.obj",
                                "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n"
                                "f -3 -2 -1\nf 1/1 2/1 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 3/1/1\n"
                                "v 0 0 1\nf -1//-1 -2//-1 -3//-1\n"));
  const auto triangles = triangles_of(scene);
  ASSERT_EQ(triangles.size(), 5u);
  for (int i = 1; i < 4; ++i) EXPECT_EQ(triangles[static_cast<std::size_t>(i)], triangles[0]);
  EXPECT_EQ(triangles[4][0], Vec3(0, 0, 1));
  EXPECT_EQ(triangles[4][2], Vec3(1, 0, 0));
}

TEST(ImportObj, FansPolygonsFromTheirFirstCorner) {
  const TemporaryFolder folder;
  const ImportedScene scene =
      import_scene(folder.write("polygon.obj", "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 2 3 4 5 1\n"));
  const auto triangles = triangles_of(scene);
  ASSERT_EQ(triangles.size(), 3u);
  for (const Triangle& t : triangles) EXPECT_EQ(t[0], Vec3(1, 0, 0));
  EXPECT_EQ(triangles[2][1], Vec3(0, 1, 0));
  EXPECT_EQ(triangles[2][2], Vec3(0, 0, 0));
}

TEST(ImportObj, NamesObjectsByObjectThenGroupThenMaterial) {
  const TemporaryFolder folder;
  const ImportedScene scene =
      import_scene(folder.write("names.obj",
                                "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl rock\nf 1 2 3\n"
                                "o House\nf 1 2 3\ng wall east\nusemtl brick\nf 1 2 3\nf 1 2 3\n"
                                "o Shed\nf 1 2 3\n"));
  ASSERT_EQ(scene.meshes.size(), 5u);
  EXPECT_EQ(scene.meshes[0].name, "names");
  EXPECT_EQ(scene.meshes[1].name, "rock");
  EXPECT_EQ(scene.meshes[2].name, "House");
  EXPECT_EQ(scene.meshes[3].name, "wall east");
  EXPECT_EQ(scene.meshes[3].triangles.size(), 2u);
  EXPECT_EQ(scene.meshes[4].name, "Shed");
}

TEST(ImportObj, KeepsTheOrderOfTheFileWhenObjectsRepeat) {
  const TemporaryFolder folder;
  const ImportedScene scene = import_scene(folder.write("repeat.obj",
                                                        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                                        "g a\nf 1 2 3\ng b\nf 2 3 4\ng a\nf 1 2 4\n"));
  ASSERT_EQ(scene.meshes.size(), 3u);
  EXPECT_EQ(scene.meshes[0].name, "a");
  EXPECT_EQ(scene.meshes[1].name, "b");
  EXPECT_EQ(scene.meshes[2].name, "a");
  EXPECT_EQ(triangles_of(scene)[2][2], Vec3(0, 0, 1));
  // Each mesh holds the vertices that it uses, no others.
  for (const Mesh& mesh : scene.meshes) EXPECT_EQ(mesh.vertices.size(), 3u);
}

TEST(ImportObj, ReadsAnyLineEndContinuedLinesAndAFileWithoutALastLineEnd) {
  const TemporaryFolder folder;
  const std::string lines[] = {"# hello", "v 0 0 0", "v 1 0 0 # one", "v 0 1 \\", " 0", "f 1 2 \\", "3"};
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string text;
    for (const std::string& line : lines) {
      if (!text.empty()) text += end;
      text += line;
    }
    const auto triangles = triangles_of(import_scene(folder.write("lines.obj", text)));
    ASSERT_EQ(triangles.size(), 1u);
    EXPECT_EQ(triangles[0][2], Vec3(0, 1, 0));
  }
}

TEST(ImportObj, ReadsLinesAcrossTheReadersBuffer) {
  const TemporaryFolder folder;
  // The buffer is 4 MB; a comment pushes a vertex line to every place around its end.
  for (std::size_t before = (4u << 20) - 20; before <= (4u << 20) + 2; ++before) {
    std::string text(before, '.');
    text.front() = '#';
    text.append("\nv 123.5 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto triangles = triangles_of(import_scene(folder.write("long.obj", text)));
    ASSERT_EQ(triangles.size(), 1u);
    ASSERT_EQ(triangles[0][0].x, 123.5);
  }
}

TEST(ImportObj, TellsTheLineOfAFaceWithoutItsVertices) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(import_error(folder.write("late.obj", "v 0 0 0\nv 1 0 0\n\nf 1 2 3\nv 0 1 0\n")),
                       "late.obj:4: a face refers to vertex 3, but 2 vertices come before it"));
  EXPECT_TRUE(contains(import_error(folder.write("zero.obj", "v 0 0 0\nf 0 1 1\n")), "zero.obj:2: '0' is no corner"));
  EXPECT_TRUE(contains(import_error(folder.write("minus.obj", "v 0 0 0\nf -2 1 1\n")), "minus.obj:2: "));
  EXPECT_TRUE(contains(import_error(folder.write("word.obj", "v 0 zero 0\n")), "word.obj:1: 'zero' is no coordinate"));
  EXPECT_TRUE(contains(import_error(folder.write("short.obj", "v 0 0\n")), "short.obj:1: a vertex needs three"));
}

TEST(ImportObj, SkipsFacesOfTwoCornersAndSaysSo) {
  const TemporaryFolder folder;
  const ImportedScene scene = import_scene(folder.write("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 1 2 3\nf 3\n"));
  EXPECT_EQ(scene.report.triangles, 1u);
  EXPECT_TRUE(notes_contain(scene, "2 faces with fewer than three corners were skipped, the first in line 4"));
  const ImportedScene one = import_scene(folder.write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 1 2 3\n"));
  EXPECT_TRUE(notes_contain(one, "1 face with fewer than three corners was skipped, the first in line 4"));
}

TEST(ImportObj, KeepsTrianglesThatArePointsOrSegments) {
  const TemporaryFolder folder;
  const ImportedScene scene = import_scene(folder.write("thin.obj", "v 1 2 3\nv 4 5 6\nf 1 1 1\nf 1 2 1\n"));
  EXPECT_EQ(scene.report.triangles, 2u);
}

}  // namespace
}  // namespace roam::test
