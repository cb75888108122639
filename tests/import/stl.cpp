// STL: ascii and binary, and telling one from the other.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "import_files.h"

namespace roam::test {
namespace {

std::string binary_stl(const std::string& header, const std::vector<std::array<float, 9>>& facets) {
  std::string bytes = header;
  bytes.resize(80, '\0');
  bytes += bytes_of(static_cast<std::uint32_t>(facets.size()));
  for (const auto& facet : facets) {
    for (int k = 0; k < 3; ++k) bytes += bytes_of(0.0f);
    for (const float c : facet) bytes += bytes_of(c);
    bytes += bytes_of(std::uint16_t{0});
  }
  return bytes;
}

const std::string ascii_facet =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n endloop\nendfacet\n";

TEST(ImportStl, KeepsEveryDigitOfAsciiFiles) {
  const TemporaryFolder folder;
  const ImportedScene scene = import_scene(folder.write("far.stl",
                                                        "solid far\nfacet normal nan nan nan\nouter loop\n"
                                                        "vertex 4012345.678901234 5412345.123456789 312.0001\n"
                                                        "vertex 4012346 5412345 312\nvertex 4012345 5412346 312\n"
                                                        "endloop\nendfacet\nendsolid far\n"));
  EXPECT_EQ(triangles_of(scene)[0][0], Vec3(4012345.678901234, 5412345.123456789, 312.0001));
}

TEST(ImportStl, KeepsTheFloatsOfBinaryFiles) {
  const TemporaryFolder folder;
  const ImportedScene scene =
      import_scene(folder.write("box.stl", binary_stl("", {{0.1f, 2, 3, 4, 5, 6, 7, 8, 9.5f}})));
  const Triangle t = triangles_of(scene)[0];
  EXPECT_EQ(t[0], Vec3(static_cast<double>(0.1f), 2, 3));
  EXPECT_EQ(t[2], Vec3(7, 8, 9.5));
}

TEST(ImportStl, ReadsBinaryFilesThatBeginWithSolid) {
  const TemporaryFolder folder;
  const auto facets = std::vector<std::array<float, 9>>(3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  EXPECT_EQ(import_scene(folder.write("a.stl", binary_stl("solid exported by CAD", facets))).report.triangles, 3u);
  // Also when bytes follow that the header does not count: they are told.
  const ImportedScene more = import_scene(folder.write("b.stl", binary_stl("solid exported by CAD", facets) + "tail"));
  EXPECT_EQ(more.report.triangles, 3u);
  EXPECT_TRUE(notes_contain(more, "4 bytes after the last of the 3 triangles"));
}

TEST(ImportStl, MakesAnObjectOfEachAsciiSolid) {
  const TemporaryFolder folder;
  const ImportedScene scene = import_scene(folder.write(
      "two.stl", "solid Hull\n" + ascii_facet + ascii_facet + "endsolid Hull\nSOLID\n" + ascii_facet + "ENDSOLID\n"));
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.meshes[0].name, "Hull");
  EXPECT_EQ(scene.meshes[0].triangles.size(), 2u);
  EXPECT_EQ(scene.meshes[1].name, "two");
}

TEST(ImportStl, SharesEqualVerticesWithoutMovingAny) {
  const TemporaryFolder folder;
  const ImportedScene scene = import_scene(
      folder.write("shared.stl", binary_stl("", {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {1, 0, 0, 0, 1, 0, 1, 1, 0}})));
  EXPECT_EQ(scene.meshes[0].vertices.size(), 4u);
  EXPECT_EQ(triangles_of(scene)[1][2], Vec3(1, 1, 0));
}

TEST(ImportStl, TellsWhereAFileIsCutOrWrong) {
  const TemporaryFolder folder;
  const std::string whole = binary_stl("", std::vector<std::array<float, 9>>(5));
  EXPECT_TRUE(contains(import_error(folder.write("cut.stl", whole.substr(0, 84 + 3 * 50 + 7))),
                       "the header says 5 triangles, but the file ends after 3"));
  EXPECT_TRUE(contains(import_error(folder.write("tiny.stl", "solid")), "tiny.stl:1: the file ends inside a solid"));
  EXPECT_TRUE(contains(import_error(folder.write("short.stl", "abc")), "shorter than the 84 bytes of a header"));
  EXPECT_TRUE(contains(import_error(folder.write("loop.stl", "solid a\nfacet normal 0 0 1\nvertex 0 0 0\n")),
                       "loop.stl:3: 'vertex' is not expected here"));
  EXPECT_TRUE(
      contains(import_error(folder.write("word.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 oops 0\n")),
               "word.stl:4: 'oops' is no coordinate"));
}

TEST(ImportStl, LeavesOutTrianglesWithBadVerticesAndNamesTheirObject) {
  const TemporaryFolder folder;
  const float infinite = std::numeric_limits<float>::infinity();
  const ImportedScene scene =
      import_scene(folder.write("bad.stl", binary_stl("", {{0, 0, 0, 1, 0, 0, 0, 1, 0},
                                                           {std::nanf(""), 0, 0, 1, 0, 0, 0, 1, 0},
                                                           {2e9f, 0, 0, 1, 0, 0, 0, infinite, 0},
                                                           {5, 5, 5, 1, 0, 0, 0, 1, 0}})));
  EXPECT_EQ(scene.report.triangles, 2u);
  EXPECT_EQ(scene.report.bad_vertices, 3u);
  EXPECT_EQ(scene.report.bad_triangles, 2u);
  ASSERT_EQ(scene.report.bad_objects.size(), 1u);
  EXPECT_EQ(scene.report.bad_objects[0].name, "bad");
  EXPECT_EQ(triangles_of(scene)[1][0], Vec3(5, 5, 5));
  EXPECT_TRUE(notes_contain(scene, "2 triangles were left out"));
}

}  // namespace
}  // namespace roam::test
