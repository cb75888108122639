// Formats by way of assimp, axes and units, several files in one scene, and files that are none.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "collada_made.h"
#include "import_files.h"

namespace roam::test {
namespace {

const std::string one_triangle = "v 1 2 3\nv 4 5 6\nv 7 9 8\nf 1 2 3\n";

Triangle first_triangle(const std::filesystem::path& path, const ImportOptions& options = {}) {
  return triangles_of(import_scene(path, options)).at(0);
}

/// A glTF file with its data inside: one triangle in a node that moves it by (10, 20, 30).
std::string gltf() {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
    "nodes":[{"name":"Door","mesh":0,"translation":[10,20,30]}],
    "meshes":[{"name":"Panel","primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
    "bufferViews":[{"buffer":0,"byteLength":36}],
    "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}

TEST(ImportFormats, TurnsGltfUprightUnlessTold) {
  const TemporaryFolder folder;
  const auto file = folder.write("door.gltf", gltf());
  EXPECT_EQ(first_triangle(file)[1], Vec3(11, -30, 20));
  EXPECT_EQ(first_triangle(file, {.up = UpAxis::z})[1], Vec3(11, 20, 30));
  EXPECT_EQ(import_scene(file).meshes[0].name, "Door");
  EXPECT_TRUE(contains(import_error(file, {.ignore = {"Panel"}}), "to be ignored"));
}

TEST(ImportFormats, ReadsDataInGltfWhoseBytesAreEscaped) {
  const TemporaryFolder folder;
  std::string escaped = gltf();
  escaped.replace(escaped.find("CAPw"), 4, "CA%50%77");
  EXPECT_EQ(first_triangle(folder.write("door.gltf", escaped))[1], Vec3(11, -30, 20));
}

TEST(ImportFormats, LeavesColladaAsItIsAndSaysWhatItStates) {
  const TemporaryFolder folder;
  for (const std::string up : {"X_UP", "Y_UP", "Z_UP"}) {
    const ImportedScene scene = import_scene(folder.write("floor.dae", collada(up, "0.0254")));
    const auto triangles = triangles_of(scene);
    ASSERT_EQ(triangles.size(), 2u);
    EXPECT_EQ(triangles[1], (Triangle{Vec3(10, 20, 30), Vec3(11, 21, 30), Vec3(10, 21, 30)}));
    EXPECT_EQ(scene.meshes[0].name, "Floor");
    EXPECT_TRUE(notes_contain(scene, "its unit is 0.0254 m"));
    EXPECT_EQ(scene.report.stated_unit, LengthUnit::in);
    EXPECT_EQ(notes_contain(scene, "axis is up"), up != "Z_UP");
    // Words for the command line and for a program.
    EXPECT_TRUE(notes_contain(scene, "read it with its unit (--unit in)"));
    EXPECT_EQ(notes_contain(scene, "read it with up = y (--up=y)"), up == "Y_UP");
  }
  const auto file = folder.write("floor.dae", collada("Y_UP", "0.0254"));
  const ImportedScene told = import_scene(file, {.up = UpAxis::y, .unit = LengthUnit::in});
  EXPECT_TRUE(told.report.notes.empty());
  EXPECT_EQ(triangles_of(told)[0][0], Vec3(10 * 0.0254, -30 * 0.0254, 20 * 0.0254));
}

TEST(ImportFormats, NamesTheUnitThatAFileStatesAsTheCommandLineDoes) {
  const TemporaryFolder folder;
  const auto note = [&](const std::string& metres, LengthUnit read_as) {
    const auto& notes =
        import_scene(folder.write("floor.dae", collada("Z_UP", metres)), {.unit = read_as}).report.notes;
    return notes.empty() ? std::string() : notes.front();
  };
  for (const auto& [metres, name] : {std::pair("0.01", "cm"), std::pair("0.001", "mm"), std::pair("0.3048", "ft"),
                                     std::pair("0.02539999969", "in")}) {
    EXPECT_NE(note(metres, LengthUnit::m).find(std::string("(--unit ") + name + ")"), std::string::npos) << metres;
  }
  EXPECT_NE(note("1", LengthUnit::ft).find("(--unit m)"), std::string::npos);
  const std::string yards = note("0.9144", LengthUnit::m);
  EXPECT_NE(yards.find("its unit is 0.9144 m"), std::string::npos) << yards;
  EXPECT_EQ(yards.find("(--unit"), std::string::npos) << yards << ": there is no such unit to say";
}

TEST(ImportFormats, LeavesFbxAsItIsAndSaysWhatItStates) {
  const TemporaryFolder folder;
  const auto file = folder.write("gate.fbx", R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {
	FBXHeaderVersion: 1003
	FBXVersion: 7400
}
GlobalSettings:  {
	Version: 1000
	Properties70:  {
		P: "UpAxis", "int", "Integer", "",1
		P: "UnitScaleFactor", "double", "Number", "",1
	}
}
Objects:  {
	Geometry: 100, "Geometry::Slab", "Mesh" {
		Vertices: *12 {
			a: 0,0,0,1,0,0,1,1,0,0,1,0.5
		}
		PolygonVertexIndex: *4 {
			a: 0,1,2,-4
		}
		GeometryVersion: 124
	}
	Model: 200, "Model::Gate", "Mesh" {
		Version: 232
		Properties70:  {
			P: "Lcl Translation", "Lcl Translation", "", "A",10,20,30
		}
	}
}
Connections:  {
	C: "OO",200,0
	C: "OO",100,200
}
)");
  const ImportedScene scene = import_scene(file);
  const auto triangles = triangles_of(scene);
  ASSERT_EQ(triangles.size(), 2u);
  EXPECT_EQ(triangles[1], (Triangle{Vec3(10, 20, 30), Vec3(11, 21, 30), Vec3(10, 21, 30.5)}));
  EXPECT_EQ(scene.meshes[0].name, "Gate");
  EXPECT_TRUE(notes_contain(scene, "its y axis is up"));
  EXPECT_TRUE(notes_contain(scene, "its unit is 0.01 m"));
}

TEST(ImportFormats, SaysWhereAReaderThatKeepsFloatsRounds) {
  const TemporaryFolder folder;
  const ImportedScene far = import_scene(folder.write("far.off", "OFF\n3 1 0\n4000000.3 0 0\n1 0 0\n1 1 0\n3 0 1 2\n"));
  EXPECT_TRUE(notes_contain(far, "Coordinates of up to 4000000 m"));
  EXPECT_TRUE(notes_contain(far, "rounded by up to 0.24 m"));
  const ImportedScene near = import_scene(folder.write("near.off", "OFF\n3 1 0\n8000.3 0 0\n1 0 0\n1 1 0\n3 0 1 2\n"));
  EXPECT_TRUE(near.report.notes.empty());
}

TEST(ImportFormats, ReadsOff) {
  const TemporaryFolder folder;
  const ImportedScene scene =
      import_scene(folder.write("quad.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n4 0 1 2 3\n"));
  EXPECT_EQ(scene.report.triangles, 2u);
  EXPECT_EQ(scene.meshes[0].name, "quad");
}

TEST(ImportFormats, TurnsEachAxisUpAndScalesEachUnit) {
  const TemporaryFolder folder;
  const auto file = folder.write("axes.obj", one_triangle);
  EXPECT_EQ(first_triangle(file)[0], Vec3(1, 2, 3));
  EXPECT_EQ(first_triangle(file, {.up = UpAxis::z})[0], Vec3(1, 2, 3));
  EXPECT_EQ(first_triangle(file, {.up = UpAxis::y})[0], Vec3(1, -3, 2));
  EXPECT_EQ(first_triangle(file, {.up = UpAxis::x})[0], Vec3(-3, 2, 1));
  EXPECT_EQ(first_triangle(file, {.up = UpAxis::minus_x})[0], Vec3(3, 2, -1));
  EXPECT_EQ(first_triangle(file, {.up = UpAxis::minus_y})[0], Vec3(1, 3, -2));
  EXPECT_EQ(first_triangle(file, {.up = UpAxis::minus_z})[0], Vec3(1, -2, -3));
  EXPECT_EQ(first_triangle(file, {.unit = LengthUnit::cm})[0], Vec3(0.01, 0.02, 3 * 0.01));
  EXPECT_EQ(first_triangle(file, {.unit = LengthUnit::mm})[1], Vec3(4 * 0.001, 5 * 0.001, 6 * 0.001));
  EXPECT_EQ(first_triangle(file, {.unit = LengthUnit::ft})[0], Vec3(0.3048, 2 * 0.3048, 3 * 0.3048));
  EXPECT_EQ(first_triangle(file, {.unit = LengthUnit::in})[0], Vec3(0.0254, 2 * 0.0254, 3 * 0.0254));
}

TEST(ImportFormats, MakesNoNegativeZeros) {
  const TemporaryFolder folder;
  const auto file = folder.write("zero.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_FALSE(std::signbit(first_triangle(file, {.up = UpAxis::y})[0].y));
  EXPECT_FALSE(std::signbit(first_triangle(file, {.up = UpAxis::x})[0].x));
}

TEST(ImportFormats, ParsesAxesAndUnitsAndRefusesOthers) {
  EXPECT_EQ(parse_up_axis("y"), UpAxis::y);
  for (const char* axis : {"x", "y", "z", "-x", "-y", "-z"}) EXPECT_STREQ(to_string(parse_up_axis(axis)), axis);
  EXPECT_EQ(parse_length_unit("in"), LengthUnit::in);
  EXPECT_EQ(metres_per(parse_length_unit("ft")), 0.3048);
  EXPECT_THROW(static_cast<void>(parse_up_axis("Y")), Error);
  EXPECT_THROW(static_cast<void>(parse_length_unit("km")), Error);
}

TEST(ImportFormats, ChecksTheLimitInMetresNotInTheUnitOfTheFile) {
  const TemporaryFolder folder;
  const auto file = folder.write("limit.obj", "v 1e9 0 0\nv 1000000001 0 0\nv 0 1 0\nf 1 3 3\nf 2 3 3\n");
  EXPECT_EQ(import_scene(file).report.bad_triangles, 1u);
  EXPECT_EQ(import_scene(file, {.unit = LengthUnit::mm}).report.bad_triangles, 0u);
}

TEST(ImportFormats, MergesFilesInTheOrderGiven) {
  const TemporaryFolder folder;
  const std::vector<std::filesystem::path> paths{folder.write("b.obj", "v 5 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 2 3 1\n"),
                                                 folder.write("a.obj", one_triangle)};
  const ImportedScene scene = import_scene(paths);
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.meshes[0].name, "b");
  EXPECT_EQ(triangles_of(scene)[2][0], Vec3(1, 2, 3));
  EXPECT_EQ(scene.report.files, 2u);
  EXPECT_EQ(scene.report.triangles, 3u);
}

TEST(ImportFormats, RefusesWhatIsNoSceneAndSaysWhatToDo) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(import_error(folder.path() / "gone.obj"), "there is no such file or folder"));
  EXPECT_TRUE(
      contains(import_error(folder.path()), "this folder holds no Data/Tile_*/Tile_*.osgb and no tileset.json"));
  folder.write("part.osgb", "");
  EXPECT_TRUE(contains(import_error(folder.path()), "name its files: " + (folder.path() / "*.osgb").string()));
  EXPECT_TRUE(contains(import_error(folder.write("empty.obj", "")), "this file is empty"));
  EXPECT_TRUE(
      contains(import_error(folder.write("notes.txt", "hello")), "knows no reader for '.txt' files. It reads obj"));
  EXPECT_TRUE(contains(import_error(folder.write("none", "hello")), "knows no reader for '.' files"));
  EXPECT_TRUE(contains(import_error(folder.write("tiles.b3dm", "b3dm")), "it ends in its header"));
  EXPECT_TRUE(contains(import_error(folder.write("city.3tz", "PK")), "no whole zip archive"));
  EXPECT_TRUE(contains(import_error(folder.write("dem.tif", "II*")), "elevation rasters are not read yet"));
  EXPECT_TRUE(contains(import_error(folder.write("points.obj", "v 1 2 3\n")), "this gives no triangle"));
  EXPECT_TRUE(
      contains(import_error(folder.write("nan.obj", "v nan 2 3\nf 1 1 1\n")), "none of its 1 triangles is usable"));
  EXPECT_TRUE(contains(import_error(folder.write("garbage.ive", "garbage")), "OpenSceneGraph cannot read this file"));
  EXPECT_TRUE(
      contains(import_error(folder.write("garbage.glb", "garbage")), "begins neither as binary glTF nor as JSON"));
  EXPECT_TRUE(
      contains(import_error(folder.write("lfs.glb", "version https://git-lfs.github.com/spec/v1\noid sha256:0\n")),
               "run 'git lfs pull'"));
  EXPECT_TRUE(contains(import_error(folder.write("utf16.obj", std::string("\xff\xfev\0 \0", 6))), "save it as UTF-8"));
  EXPECT_TRUE(contains(import_error("/dev/null"), "neither a file nor a folder"));
  EXPECT_THROW(static_cast<void>(import_scene(std::span<const std::filesystem::path>())), Error);
}

TEST(ImportFormats, ReadsExtensionsInAnyCaseAndPathsOfAnyCharacters) {
  const TemporaryFolder folder;
  EXPECT_EQ(import_scene(folder.write("--up.OBJ", one_triangle)).report.triangles, 1u);
  EXPECT_EQ(import_scene(folder.write("na\xc3\xafve scene 'x' $(y).Obj", one_triangle)).report.triangles, 1u);
}

}  // namespace
}  // namespace roam::test
