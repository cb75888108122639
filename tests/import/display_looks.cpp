// Colours, images, normals and transparency of what is to be seen.

#include <cstring>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "shown_scene.h"

namespace roam::test {
namespace {

const std::string obj_vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 2\n";

TEST(ImportDisplayLooks, ReadsMaterialsOfObj) {
  const TemporaryFolder folder;
  folder.write("Images/Brick.BMP", bmp(two_texels));
  folder.write(
      "house.mtl",
      "newmtl brick\nKd 0.2 0.2 0.2\nmap_Kd -s 1 1 1 C:\\work\\images\\brick.bmp\nnewmtl paint\nKd 1 0.5 0\nnewmtl "
      "glass\nKd 0 0 1\nd 0.5\nnewmtl air\nd 0\nKd 0 1 0\n");
  const auto file =
      folder.write("house.obj", obj_vertices +
                                    "mtllib house.mtl\nf 1 2 3\nusemtl brick\nf 1/1/1 2/2/1 -2/-2/-1\nusemtl "
                                    "paint\nf 1/1 2/2 3/3\nusemtl glass\nf 1//1 2//1 3//1\nusemtl "
                                    "nobody's\nf 1 2 4\nusemtl air\nf 1 3 4\n");
  const Shown shown = show({file});
  EXPECT_EQ(not_shown(import_scene(file), shown, 1e-6), 0u);
  EXPECT_TRUE(shown.report.notes.empty());
  std::multiset<std::string> seen;
  for (const ShownTriangle& t : shown.triangles) {
    const Colour c = t.colours[1];
    const bool blended = t.look.cover == DisplayCover::blended;
    seen.insert(std::to_string(c[0]) + " " + std::to_string(c[1]) + " " + std::to_string(c[2]) + " " +
                std::to_string(c[3]) + (t.image != nullptr ? " image" : "") + (blended ? " blended" : "") +
                (t.normals[0] == glm::vec3(0, 0, 1) ? " normal" : ""));
    if (t.image == nullptr) continue;
    EXPECT_EQ(row_of(*t.image), two_texels);
    EXPECT_EQ(t.coordinates, (std::array{glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1)}));
  }
  EXPECT_EQ(seen, (std::multiset<std::string>{"255 255 255 255", "255 255 255 255 image normal", "255 128 0 255",
                                              "0 0 255 128 blended normal", "255 255 255 255", "0 255 0 255"}));
  EXPECT_EQ(shown.report.textures, 1u);
  EXPECT_EQ(shown.report.missing_textures, 0u);
}

TEST(ImportDisplayLooks, ReadSeveralFilesOfMaterialsOfOneLine) {
  const TemporaryFolder folder;
  folder.write("red.mtl", "newmtl red\nKd 1 0 0\n");
  folder.write("dark green.mtl", "newmtl green\nKd 0 1 0\n");
  folder.write("blue.mtl", "newmtl blue\nKd 0 0 1\n");
  const Shown shown = show({folder.write(
      "a.obj", obj_vertices + "mtllib red.mtl  blue.mtl gone.mtl\nmtllib dark green.mtl\nmtllib no one.mtl\nusemtl "
                              "red\nf 1 2 3\nusemtl green\nf 1 2 4\nusemtl blue\nf 1 3 4\n")});
  std::set<Colour> colours;
  for (const ShownTriangle& t : shown.triangles) colours.insert(t.colours[0]);
  EXPECT_EQ(colours, (std::set<Colour>{{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}}));
  const std::vector<std::string>& notes = shown.report.import.notes;
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_TRUE(contains(notes[0], "/gone.mtl: this file of materials is not there"));
  EXPECT_TRUE(contains(notes[1], "/no one.mtl: this file of materials is not there"));
}

TEST(ImportDisplayLooks, SendAnImageOnceHoweverItsNameIsWritten) {
  const TemporaryFolder folder;
  folder.write("wall.bmp", bmp(two_texels));
  std::filesystem::create_symlink("wall.bmp", folder.path() / "link.bmp");
  std::string materials, faces;
  int count = 0;
  for (const char* name : {"wall.bmp", "./wall.bmp", "././wall.bmp", "WALL.bmp", "link.bmp", "x/../wall.bmp"}) {
    const std::string material = std::to_string(++count);
    materials += "newmtl " + material + "\nmap_Kd " + name + "\n";
    faces += "usemtl " + material + "\nf 1/1 2/2 3/3\n";
  }
  folder.write("a.mtl", materials);
  const Shown shown = show({folder.write("a.obj", obj_vertices + "mtllib a.mtl\n" + faces)});
  std::set<const DisplayTexture*> images;
  for (const ShownTriangle& t : shown.triangles) images.insert(t.image);
  EXPECT_EQ(images.size(), 1u);
  EXPECT_FALSE(images.contains(nullptr));
  EXPECT_EQ(shown.report.textures, 1u);
}

// The sizes in the file's head are four bytes each, and their product is 2^32 texels, which 32 bits count as none.
TEST(ImportDisplayLooks, RefuseAnImageThatClaimsMoreTexelsThanItHas) {
  const TemporaryFolder folder;
  std::string dds(128, '\0');
  const auto put = [&](std::size_t at, std::uint32_t value) { std::memcpy(dds.data() + at, &value, sizeof value); };
  std::memcpy(dds.data(), "DDS ", 4);
  put(4, 124), put(8, 0x21007), put(12, 4), put(16, 0x40000000), put(28, 1), put(76, 32), put(80, 0x41), put(88, 32);
  put(92, 0xff0000), put(96, 0xff00), put(100, 0xff), put(104, 0xff000000), put(108, 0x401008);
  folder.write("lie.dds", dds + std::string(64, '\xaa'));
  folder.write("a.mtl", "newmtl a\nmap_Kd lie.dds\n");
  const Shown shown = show({folder.write("a.obj", obj_vertices + "mtllib a.mtl\nusemtl a\nf 1/1 2/2 3/3\n")});
  ASSERT_EQ(shown.triangles.size(), 1u);
  EXPECT_EQ(shown.triangles[0].image, nullptr);
  EXPECT_EQ(shown.report.missing_texture_files, std::vector<std::string>{"lie.dds"});
}

TEST(ImportDisplayLooks, NamesWhatIsMissing) {
  const TemporaryFolder folder;
  folder.write("a.mtl",
               "newmtl a\nmap_Kd gone.png\nnewmtl b\nmap_Kd broken.jpg\nnewmtl c\nmap_Kd http://localhost/x.png\n");
  folder.write("broken.jpg", "\xff\xd8\xff garbage");
  const std::string faces =
      "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\nusemtl c\nf 1/1 2/2 3/3\nusemtl a\nf 1/1 3/3 4/4\n";
  const Shown shown = show({folder.write("a.obj", obj_vertices + "mtllib a.mtl\n" + faces)});
  EXPECT_EQ(shown.triangles.size(), 4u);
  for (const ShownTriangle& t : shown.triangles) EXPECT_EQ(t.image, nullptr);
  EXPECT_EQ(shown.report.missing_textures, 3u);
  EXPECT_EQ(shown.report.missing_texture_files,
            (std::vector<std::string>{"gone.png", "broken.jpg", "http://localhost/x.png"}));
  ASSERT_EQ(shown.report.notes.size(), 1u);
  EXPECT_TRUE(contains(shown.report.notes[0], "3 images that the scene refers to are absent or unreadable"));

  const Shown without = show({folder.write("b.obj", obj_vertices + "mtllib gone.mtl\n" + faces)});
  ASSERT_EQ(without.report.import.notes.size(), 1u);
  EXPECT_TRUE(contains(without.report.import.notes[0], "gone.mtl: this file of materials is not there"));
}

TEST(ImportDisplayLooks, ReadsVertexColours) {
  const TemporaryFolder folder;
  const auto obj = folder.write("a.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 1 0 0 1\nv 2 2 2\nf 1 2 3\nf 1 2 4\n");
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const auto bytes = folder.write("b.ply", header + "property uchar red\nproperty uchar green\nproperty uchar blue\n" +
                                               "property uchar alpha\n" + faces +
                                               "0 0 0 255 0 0 0\n1 0 0 0 255 0 0\n1 1 0 0 0 255 0\n3 0 1 2\n");
  const auto floats = folder.write("c.ply", header + "property float red\nproperty float green\nproperty float blue\n" +
                                                faces + "0 0 0 1 0 0\n1 0 0 0 1 0\n1 1 0 0 0 1\n3 0 1 2\n");
  const Colour red{255, 0, 0, 255}, green{0, 255, 0, 255}, blue{0, 0, 255, 255};
  const auto colours_of = [](const std::filesystem::path& file) {
    const Shown shown = show({file});
    return shown.triangles.at(0).colours;
  };
  EXPECT_EQ(colours_of(obj), (std::array{red, green, blue}));
  EXPECT_EQ(show({obj}).triangles.at(1).colours[2], (Colour{255, 255, 255, 255}));
  EXPECT_EQ(colours_of(bytes), (std::array{red, green, blue}));
  EXPECT_EQ(colours_of(floats), (std::array{red, green, blue}));
}

TEST(ImportDisplayLooks, ReadsTheImageAndNormalsOfPly) {
  const TemporaryFolder folder;
  folder.write("atlas.bmp", bmp(two_texels));
  const Shown shown =
      show({folder.write(
               "a.ply",
               "ply\nformat ascii 1.0\ncomment TextureFile atlas.bmp\nelement vertex 3\nproperty float x\nproperty "
               "float y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty float "
               "s\nproperty float t\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 0 3 0 "
               "0 0\n1 0 0 0 3 0 1 0\n1 1 0 0 3 0 1 0.5\n3 0 1 2\n")},
           {.up = UpAxis::y});
  const ShownTriangle& t = shown.triangles.at(0);
  ASSERT_NE(t.image, nullptr);
  EXPECT_EQ(row_of(*t.image), two_texels);
  EXPECT_EQ(t.coordinates[2], glm::vec2(1, 0.5f));
  // Turned with the scene.
  EXPECT_EQ(t.normals[0], glm::vec3(0, 0, 1));
}

TEST(ImportDisplayLooks, ReadsWhatFacesOfPlySayAboutImages) {
  const TemporaryFolder folder;
  folder.write("a.bmp", bmp(two_texels));
  folder.write("b.bmp", bmp({two_texels[1]}));
  const auto file = folder.write(
      "a.ply",
      "ply\nformat ascii 1.0\ncomment TextureFile a.bmp\ncomment TextureFile b.bmp\nelement vertex 4\nproperty float "
      "x\n"
      "property float y\nproperty float z\nelement face 3\nproperty list uchar float texcoord\nproperty list uchar int "
      "vertex_indices\nproperty int texnumber\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n6 0 0 1 0 1 0.5 3 0 1 2 0\n"
      "8 0.25 0 1 0 1 1 0 1 4 0 1 2 3 1\n0 3 1 2 3 1\n");
  const Shown shown = show({file});
  EXPECT_EQ(not_shown(import_scene(file), shown, 1e-6), 0u);
  ASSERT_EQ(shown.triangles.size(), 4u);
  std::map<std::string, int> seen;
  for (const ShownTriangle& t : shown.triangles) {
    const std::string image = t.image == nullptr ? "none" : row_of(*t.image) == two_texels ? "a" : "b";
    ++seen[image + " " + std::to_string(t.coordinates[0].x) + " " + std::to_string(t.coordinates[2].y)];
  }
  EXPECT_EQ(seen, (std::map<std::string, int>{
                      {"none 0.000000 0.000000", 1}, {"a 0.000000 0.500000", 1}, {"b 0.250000 1.000000", 2}}));
  EXPECT_TRUE(contains(
      display_error(folder.write("bad.ply",
                                 "ply\nformat ascii 1.0\ncomment TextureFile a.bmp\nelement vertex 1\nproperty float "
                                 "x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int "
                                 "vertex_indices\nproperty list uchar float texcoord\nend_header\n0 0 0\n3 0 0 1 0\n")),
      "a face refers to vertex 1, but 1 vertices come before it"));
}

/// A square in OpenSceneGraph's text format with a state, colours and coordinates.
std::string square(const std::string& state, const std::string& colours) {
  return "Geode {\nnum_drawables 1\nGeometry {\n" + state +
         "Primitives 2\n{\nDrawArrays TRIANGLES 0 3\nDrawElementsUShort TRIANGLES 3 {\n2 3 0\n}\n}\nVertexArray "
         "Vec3Array "
         "4\n{\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n}\nNormalBinding OVERALL\nNormalArray Vec3Array 1\n{\n0 0 1\n}\n" +
         colours + "TexCoordArray 0 Vec2Array 4\n{\n0 0\n1 0\n1 1\n0 1\n}\n}\n}\n";
}

std::string material(const std::string& mode) {
  return "Material {\nColorMode " + mode + "\ndiffuseColor 0 1 0 1\n}\n";
}

TEST(ImportDisplayLooks, MultipliesMaterialsAndColoursOfOpenSceneGraphAsItDoes) {
  const TemporaryFolder folder;
  const std::string by_set = "ColorBinding PER_PRIMITIVE_SET\nColorArray Vec4Array 2\n{\n1 0 0 1\n0 0 1 1\n}\n";
  const auto colours_of = [&](const std::string& content) {
    const Shown shown = show({folder.write("a.osg", content)});
    return std::pair(shown.triangles.at(0).colours[0], shown.triangles.at(1).colours[1]);
  };
  const Colour red{255, 0, 0, 255}, green{0, 255, 0, 255}, blue{0, 0, 255, 255};
  const auto state = [](const std::string& inside) { return "StateSet {\n" + inside + "}\n"; };
  EXPECT_EQ(colours_of(square("", by_set)), std::pair(red, blue));
  EXPECT_EQ(colours_of(square(state(material("OFF")), by_set)), std::pair(green, green));
  EXPECT_EQ(colours_of(square(state(material("DIFFUSE")), by_set)), std::pair(red, blue));
  EXPECT_EQ(colours_of(square(state("GL_LIGHTING OFF\n" + material("OFF")), by_set)), std::pair(red, blue));
  // An ancestor that overrides goes before.
  EXPECT_EQ(colours_of("Group {\nStateSet {\n0xb50 OVERRIDE|OFF\n}\nnum_children 1\n" +
                       square(state("GL_LIGHTING ON\n" + material("OFF")), by_set) + "}\n"),
            std::pair(red, blue));
}

TEST(ImportDisplayLooks, ReadsImagesBesideFilesOfOpenSceneGraph) {
  const TemporaryFolder folder;
  folder.write("wall.bmp", bmp(two_texels));
  const auto textured = [](const std::string& image) {
    return square("StateSet {\ntextureUnit 0 {\nGL_TEXTURE_2D ON\nTexture2D {\nfile \"" + image +
                      "\"\nwrap_s CLAMP\nwrap_t REPEAT\n}\n}\n}\n",
                  "");
  };
  const Shown shown = show({folder.write("a.osg",
                                         "MatrixTransform {\nMatrix {\n1 0 0 0\n0 0 3 0\n0 -1 0 0\n5 0 0 1\n}\n"
                                         "num_children 1\n" +
                                             textured("wall.bmp") + "}\n")});
  const ShownTriangle& t = shown.triangles.at(0);
  ASSERT_NE(t.image, nullptr);
  EXPECT_EQ(row_of(*t.image), two_texels);
  EXPECT_EQ(t.coordinates[2], glm::vec2(1, 1));
  EXPECT_EQ(t.normals[0], glm::vec3(0, -1, 0));
  EXPECT_EQ(t.image->across, DisplayWrap::clamp);
  EXPECT_EQ(t.image->up, DisplayWrap::repeat);
  EXPECT_EQ(shown.report.textures, 1u);

  const Shown without = show({folder.write("b.osg", textured("gone.bmp"))});
  EXPECT_EQ(without.triangles.at(0).image, nullptr);
  EXPECT_EQ(without.report.missing_texture_files, (std::vector<std::string>{"gone.bmp"}));
}

TEST(ImportDisplayLooks, LeavesOutImagesWithGeneratedCoordinates) {
  const TemporaryFolder folder;
  folder.write("sky.bmp", bmp(two_texels));
  const std::string state =
      "StateSet {\ntextureUnit 0 {\nGL_TEXTURE_2D ON\nGL_TEXTURE_GEN_S ON\nGL_TEXTURE_GEN_T ON\nTexture2D {\nfile "
      "\"sky.bmp\"\n}\nTexGen {\nmode SPHERE_MAP\n}\n}\n}\n";
  const std::string two = "Group {\nnum_children 2\n" + square(state, "") + square(state, "") + "}\n";
  const Shown shown = show({folder.write("a.osg", two)});
  EXPECT_EQ(shown.triangles.at(0).image, nullptr);
  EXPECT_EQ(shown.triangles[0].colours[0], (Colour{255, 255, 255, 255}));
  ASSERT_EQ(shown.report.import.notes.size(), 1u);
  EXPECT_TRUE(contains(shown.report.import.notes[0], "generated coordinates"));
}

TEST(ImportDisplayLooks, HalvesHugeImages) {
  const TemporaryFolder folder;
  Row row;
  for (int i = 0; i < 5001; ++i) row.push_back(i % 2 == 0 ? two_texels[0] : two_texels[1]);
  folder.write("huge.bmp", bmp(row));
  folder.write("a.mtl", "newmtl a\nmap_Kd huge.bmp\n");
  const Shown shown = show({folder.write("a.obj", obj_vertices + "mtllib a.mtl\nusemtl a\nf 1/1 2/2 3/3\n")});
  ASSERT_NE(shown.triangles.at(0).image, nullptr);
  EXPECT_EQ(row_of(*shown.triangles[0].image), Row(2500, {128, 0, 128}));
  ASSERT_EQ(shown.report.import.notes.size(), 1u);
  EXPECT_TRUE(contains(shown.report.import.notes[0], "more than 4096 texels a side are shown smaller"));
}

TEST(ImportDisplayLooks, SendsALargeImageOnce) {
  const TemporaryFolder folder;
  // 12 MB of texels, more than a part has otherwise.
  std::string image = bmp(Row(2000, {9, 9, 9})), texels = image.substr(54);
  image.resize(54);
  const std::uint32_t rows = 2000;
  image.replace(22, 4, bytes_of(rows));
  for (std::uint32_t i = 0; i < rows; ++i) image += texels;
  folder.write("large.bmp", image);
  folder.write("small.bmp", bmp(two_texels));
  folder.write("a.mtl",
               "newmtl large\nmap_Kd large.bmp\nnewmtl small\nmap_Kd small.bmp\nnewmtl again\nmap_Kd large.bmp\n");
  std::string content = obj_vertices + "mtllib a.mtl\n";
  for (int i = 0; i < 20000; ++i) {
    content += std::string("usemtl ") + std::array{"large", "small", "again"}[i % 3] + "\n";
    content += "v " + std::to_string(i) + " 0 0\nv " + std::to_string(i) + " 1 0\nv " + std::to_string(i) + " 0 1\n";
    content += "f -1/1 -2/2 -3/3\n";
  }
  const auto file = folder.write("a.obj", content);
  const Shown shown = show({file});
  EXPECT_EQ(not_shown(import_scene(file), shown, 1e-3), 0u);
  std::set<const DisplayTexture*> images;
  for (const ShownTriangle& t : shown.triangles) images.insert(t.image);
  EXPECT_EQ(images.size(), 2u);
  EXPECT_EQ(shown.report.textures, 2u);
}

}  // namespace
}  // namespace roam::test
