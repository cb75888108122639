// PLY: three encodings, all types, polygons and strips, elements that are none of ours.

#include <gtest/gtest.h>

#include <string>

#include "import_files.h"

namespace roam::test {
namespace {

std::string header(const std::string& format, const std::string& elements, const std::string& end = "\n") {
  std::string text;
  for (const std::string& line :
       {std::string("ply"), "format " + format + " 1.0", std::string("comment made by a test")}) {
    text += line + end;
  }
  return text + elements + "end_header" + end;
}

const std::string double_vertices = "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n";
const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";

TEST(ImportPly, KeepsEveryDigitInAllThreeEncodings) {
  const TemporaryFolder folder;
  const Vec3 corners[3] = {{4012345.678901234, 5412345.123456789, 312.0001}, {1e-3, -2.5e8, 0}, {0.1, 0.2, 0.3}};
  const std::string ascii = "4012345.678901234 5412345.123456789 312.0001\n1e-3 -2.5e8 0\n0.1 0.2 0.3\n3 0 1 2\n";
  std::vector<std::string> files{header("ascii", double_vertices + faces) + ascii};
  for (const bool big : {false, true}) {
    std::string data;
    for (const Vec3& v : corners) {
      for (int k = 0; k < 3; ++k) data += bytes_of(v[k], big);
    }
    data += '\3';
    for (const std::int32_t i : {0, 1, 2}) data += bytes_of(i, big);
    files.push_back(header(big ? "binary_big_endian" : "binary_little_endian", double_vertices + faces) + data);
  }
  for (const std::string& file : files) {
    const auto triangles = triangles_of(import_scene(folder.write("digits.ply", file)));
    ASSERT_EQ(triangles.size(), 1u);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(triangles[0][k], corners[k]);
  }
}

TEST(ImportPly, IsLeftOutByTheNameOfItsFileThatItIsCalledBy) {
  const TemporaryFolder folder;
  const std::string triangle = header("ascii", double_vertices + faces) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::filesystem::path dungeon = folder.write("dungeon.ply", triangle),
                              house = folder.write("house.ply", triangle);
  // An OBJ's first object has no name, the second has.
  const std::filesystem::path yard = folder.write("yard.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ng gate\nf 1 2 3\n");
  EXPECT_EQ(import_scene(dungeon).meshes.at(0).name, "dungeon");
  EXPECT_TRUE(contains(import_error(dungeon, {.ignore = {"*"}}), "to be ignored"));
  const ImportedScene scene = import_scene({dungeon, yard}, {.ignore = {"yard"}});
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.meshes[1].name, "gate");
  EXPECT_EQ(scene.report.ignored_triangles, 1u);
  EXPECT_TRUE(scene.report.notes.empty());
  // What has a name of its own is called by that alone.
  EXPECT_TRUE(notes_contain(import_scene(yard, {.ignore = {"gate", "house"}}), "No object's name matches 'house'"));
}

template <class Count, class Index>
std::string one_face(bool big) {
  std::string data;
  for (const float c : {0, 0, 0, 1, 0, 0, 0, 1, 0}) data += bytes_of(c, big);
  data += bytes_of(Count{3}, big);
  for (const Index i : {0, 1, 2}) data += bytes_of(i, big);
  return data;
}

TEST(ImportPly, ReadsEveryIntegerTypeOfCountsAndIndices) {
  const TemporaryFolder folder;
  const std::string vertices = "element vertex 3\nproperty float x\nproperty float32 y\nproperty float z\n";
  const auto check = [&](const std::string& types, const std::string& little, const std::string& big) {
    const std::string elements = vertices + "element face 1\nproperty list " + types + " vertex_index\n";
    for (const auto& [format, data] :
         {std::pair{"binary_little_endian", little}, std::pair{"binary_big_endian", big}}) {
      const auto triangles = triangles_of(import_scene(folder.write("types.ply", header(format, elements) + data)));
      ASSERT_EQ(triangles.size(), 1u) << types;
      EXPECT_EQ(triangles[0][1], Vec3(1, 0, 0)) << types;
    }
  };
  using std::int16_t, std::int32_t, std::int8_t, std::uint16_t, std::uint32_t, std::uint8_t;
  check("char char", one_face<int8_t, int8_t>(false), one_face<int8_t, int8_t>(true));
  check("uchar uchar", one_face<uint8_t, uint8_t>(false), one_face<uint8_t, uint8_t>(true));
  check("int8 uint8", one_face<int8_t, uint8_t>(false), one_face<int8_t, uint8_t>(true));
  check("short ushort", one_face<int16_t, uint16_t>(false), one_face<int16_t, uint16_t>(true));
  check("uint16 int16", one_face<uint16_t, int16_t>(false), one_face<uint16_t, int16_t>(true));
  check("int uint", one_face<int32_t, uint32_t>(false), one_face<int32_t, uint32_t>(true));
  check("uint32 int32", one_face<uint32_t, int32_t>(false), one_face<uint32_t, int32_t>(true));
}

TEST(ImportPly, SkipsWhatIsNotGeometry) {
  const TemporaryFolder folder;
  const std::string elements =
      "obj_info scanned\nelement camera 2\nproperty float f\nproperty list uchar short k\n"
      "element vertex 3\nproperty uchar red\nproperty float z\nproperty list uint8 double w\nproperty double x\n"
      "property int y\nelement face 1\nproperty float q\nproperty list uchar int vertex_indices\n"
      "property list uchar float texcoord\nelement edge 1\nproperty int a\n";
  const ImportedScene scene = import_scene(folder.write(
      "rich.ply", header("ascii", elements) + "1.5 2 7 8\n2.5 0\n255 3 1 0.5 1 2\n0 3.5 0 4 5\n9 9 2 1 1 7 "
                                              "8\n0.5 3 0 1 2 6 0 0 1 0 1 1\n4\n"));
  const Triangle t = triangles_of(scene)[0];
  EXPECT_EQ(t[0], Vec3(1, 2, 3));
  EXPECT_EQ(t[1], Vec3(4, 5, 3.5));
  EXPECT_EQ(t[2], Vec3(7, 8, 9));
}

TEST(ImportPly, FansPolygonsAndUnrollsStrips) {
  const TemporaryFolder folder;
  const std::string five = "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 2 0\n";
  const auto fan = triangles_of(import_scene(folder.write(
      "fan.ply",
      header("ascii", five + "element face 1\nproperty list uchar int vertex_indices\n") + points + "5 1 2 3 4 0\n")));
  ASSERT_EQ(fan.size(), 3u);
  for (const Triangle& t : fan) EXPECT_EQ(t[0], Vec3(1, 0, 0));
  EXPECT_EQ(fan[2][2], Vec3(0, 0, 0));
  const auto strips = triangles_of(import_scene(
      folder.write("strip.ply", header("ascii", five + "element tristrips 1\nproperty list int int vertex_indices\n") +
                                    points + "8 0 1 2 3 -1 2 3 4\n")));
  ASSERT_EQ(strips.size(), 3u);
  // The second of a strip is turned, so that all face the same way.
  EXPECT_EQ(strips[1], (Triangle{Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}));
  EXPECT_EQ(strips[2], (Triangle{Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(0, 2, 0)}));
}

TEST(ImportPly, ReadsAnyLineEndOfTheHeaderBeforeBinaryData) {
  const TemporaryFolder folder;
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string elements;
    for (const char c : std::string("element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                                    "element face 1\nproperty list uchar uchar vertex_indices\n")) {
      elements += c == '\n' ? end : std::string(1, c);
    }
    std::string data = one_face<std::uint8_t, std::uint8_t>(false);
    data[0] = '\n';  // part of a number, not of the header
    const auto triangles =
        triangles_of(import_scene(folder.write("ends.ply", header("binary_little_endian", elements, end) + data)));
    ASSERT_EQ(triangles.size(), 1u);
    EXPECT_EQ(triangles[0][1], Vec3(1, 0, 0));
  }
}

TEST(ImportPly, TellsWhereAFileIsCutOrWrong) {
  const TemporaryFolder folder;
  const std::string points = "0 0 0\n1 0 0\n1 1 0\n";
  const auto error = [&](const std::string& content) { return import_error(folder.write("bad.ply", content)); };
  EXPECT_TRUE(contains(error("plx\n"), "bad.ply:1: this is no PLY file"));
  EXPECT_TRUE(contains(error("ply\nformat ascii 1.0\nelement vertex 3\n"), "no line 'end_header'"));
  EXPECT_TRUE(contains(error("ply\nproperty int x\n"), "bad.ply:2: a property comes before the first element"));
  EXPECT_TRUE(contains(error(header("ascii", double_vertices + faces) + points), "the file is too short for it"));
  EXPECT_TRUE(contains(error(header("ascii", double_vertices + faces) + points + "3 0 1 \n"), "it is cut short"));
  EXPECT_TRUE(contains(error(header("ascii", double_vertices + faces) + points + "3 0 1 3\n"),
                       "bad.ply:14: a face refers to vertex 3, but 3 vertices come before it"));
  EXPECT_TRUE(contains(error(header("ascii", double_vertices + faces) + points + "3 0 -1 2\n"), "vertex -1"));
  EXPECT_TRUE(contains(error(header("ascii", double_vertices + faces) + "0 0 0\n1 x 0\n1 1 0\n3 0 1 2\n"),
                       "bad.ply:12: 'x' is no number"));
  const std::string huge = "element vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n";
  EXPECT_TRUE(contains(error(header("binary_little_endian", huge) + "abc"), "the file is too short for it"));
  const std::string whole = header("binary_little_endian", double_vertices + faces) + std::string(72, '\0') + "\3" +
                            bytes_of(std::int32_t{0}) + bytes_of(std::int32_t{1}) + bytes_of(std::int32_t{2});
  EXPECT_EQ(error(whole), "");
  EXPECT_TRUE(contains(error(whole.substr(0, whole.size() - 1)), "the file ends in the middle of its data"));
}

}  // namespace
}  // namespace roam::test
