// glTF as compressors and exporters write it: the same triangles as without compression.

#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "gltf_made.h"
#include "import_files.h"
#include "program.h"
#include "roam/error.h"
#include "roam/import.h"

namespace roam::test {
namespace {

/// Expects the same triangles in the same order, to `tolerance`. They may begin with another corner.
void expect_near(const std::vector<Triangle>& got, const std::vector<Triangle>& wanted, double tolerance) {
  ASSERT_EQ(got.size(), wanted.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    std::array<double, 3> apart{};
    for (std::size_t turn = 0; turn < 3; ++turn) {
      for (std::size_t k = 0; k < 3; ++k) {
        for (int axis = 0; axis < 3; ++axis) {
          apart[turn] = std::max(apart[turn], std::abs(got[i][(k + turn) % 3][axis] - wanted[i][k][axis]));
        }
      }
    }
    worst = std::max(worst, *std::min_element(apart.begin(), apart.end()));
  }
  EXPECT_LE(worst, tolerance);
}

/// The cell of 5 mm around a corner, or a neighbour of it.
std::array<long, 3> cell_of(const Vec3& corner, const std::array<int, 3>& beside = {}) {
  std::array<long, 3> cell{};
  for (std::size_t k = 0; k < 3; ++k) cell[k] = std::lround(corner[static_cast<int>(k)] / 0.005) + beside[k];
  return cell;
}

double area_of(const std::vector<Triangle>& all) {
  double area = 0.0;
  for (const Triangle& t : all) area += 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
  return area;
}

std::vector<Triangle> read(const TemporaryFolder& folder, const MadeGltf& made, const char* name = "scene.glb") {
  return triangles_of(import_scene(folder.write(name, made.glb())));
}

/// A mesh with an attribute of three components, compressed by Draco in the order of its vertices. Floats are quantized
/// to 2^-bits of the side.
template <class T>
std::string by_draco(const std::vector<T>& values, const std::vector<std::uint32_t>& indices, draco::DataType type,
                     int bits) {
  const auto vertices = static_cast<std::uint32_t>(values.size() / 3);
  draco::Mesh mesh;
  mesh.set_num_points(vertices);
  draco::GeometryAttribute positions;
  positions.Init(draco::GeometryAttribute::POSITION, nullptr, 3, type, false, 3 * sizeof(T), 0);
  const int id = mesh.AddAttribute(positions, true, vertices);
  for (std::uint32_t i = 0; i < vertices; ++i) {
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &values[std::size_t{3} * i]);
  }
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    draco::Mesh::Face face;
    for (std::size_t k = 0; k < 3; ++k) face[k] = draco::PointIndex(indices[i + k]);
    mesh.AddFace(face);
  }
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, bits);
  encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);  // which keeps the order
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeMeshToBuffer(mesh, &buffer).ok()) throw std::runtime_error("Draco cannot encode");
  return {buffer.data(), buffer.size()};
}

std::string by_draco(const MadeGrid& grid, int bits) {
  return by_draco(grid.positions, grid.indices, draco::DT_FLOAT32, bits);
}

MadeGltf draco_gltf(const MadeGrid& grid, const std::string& compressed) {
  MadeGltf made;
  const auto view = made.add_view(compressed);
  made.json["accessors"] = {{{"componentType", type_f32}, {"type", "VEC3"}, {"count", grid.vertices()}},
                            {{"componentType", type_u32}, {"type", "SCALAR"}, {"count", grid.indices.size()}}};
  made.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  made.add_mesh(
      {{"attributes", {{"POSITION", 0}}},
       {"indices", 1},
       {"extensions", {{"KHR_draco_mesh_compression", {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}}}}}});
  return made;
}

TEST(ImportGltf, GivesTheTrianglesThatDracoCompressed) {
  const TemporaryFolder folder;
  const MadeGrid grid(20);
  const std::vector<Triangle> plain = read(folder, grid.gltf());
  ASSERT_EQ(plain.size(), 800u);
  const ImportedScene scene = import_scene(folder.write("draco.glb", draco_gltf(grid, by_draco(grid, 14)).glb()));
  expect_near(triangles_of(scene), plain, 1.0 / (1 << 14));
  EXPECT_TRUE(scene.report.notes.empty());
}

TEST(ImportGltf, ScalesNormalizedIntegersThatDracoCompressed) {
  const TemporaryFolder folder;
  const std::vector<std::uint32_t> corners{0, 1, 2};
  const auto xs_of = [&](MadeGltf made, int type) {
    made.json["accessors"][0]["componentType"] = type;
    made.json["accessors"][0]["count"] = 3;
    made.json["accessors"][0]["normalized"] = true;
    const Triangle t = read(folder, made).at(0);
    return std::set<double>{t[0].x, t[1].x, t[2].x};
  };
  // Draco's own attribute says nothing of it, as that of its encoder in JavaScript.
  const std::vector<std::int16_t> words{-32768, 0, 0, 32767, 0, 0, 0, 0, -32767};
  EXPECT_EQ(xs_of(draco_gltf(MadeGrid(1), by_draco(words, corners, draco::DT_INT16, 0)), 5122),
            (std::set<double>{-1.0, 0.0, 1.0}));
  const std::vector<std::uint8_t> bytes{0, 0, 0, 255, 0, 0, 0, 255, 0};
  EXPECT_EQ(xs_of(draco_gltf(MadeGrid(1), by_draco(bytes, corners, draco::DT_UINT8, 0)), 5121),
            (std::set<double>{0.0, 1.0}));
}

TEST(ImportGltf, RefusesWhatDracoCannotDecode) {
  const TemporaryFolder folder;
  const MadeGrid grid(20);
  std::string compressed = by_draco(grid, 14);
  for (const std::size_t kept : {std::size_t{0}, std::size_t{4}, compressed.size() / 2}) {
    EXPECT_TRUE(contains(import_error(folder.write("cut.glb", draco_gltf(grid, compressed.substr(0, kept)).glb())),
                         "Draco cannot decode"))
        << kept;
  }
}

/// Puts compressed bytes in place of a buffer view's, whose buffer no reader that knows the extension opens.
void compress(MadeGltf& made, std::size_t view, const std::string& bytes, const Json& extension) {
  const std::size_t compressed = made.add_view(bytes);
  Json described = extension;
  described.update(made.json["bufferViews"][compressed]);
  made.json["bufferViews"][view]["buffer"] = 1;
  made.json["bufferViews"][view]["byteOffset"] = 0;
  made.json["bufferViews"][view]["extensions"] = {{"EXT_meshopt_compression", described}};
}

std::string encoded_vertices(const void* values, std::size_t count, std::size_t stride) {
  std::string bytes(meshopt_encodeVertexBufferBound(count, stride), '\0');
  bytes.resize(
      meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), values, count, stride));
  return bytes;
}

/// A grid whose positions and indices EXT_meshopt_compression compresses.
MadeGltf meshopt_gltf(const MadeGrid& grid, bool exponential, bool sequence) {
  MadeGltf made = grid.gltf();
  std::vector<float> positions = grid.positions;
  Json attributes{{"mode", "ATTRIBUTES"}, {"count", grid.vertices()}, {"byteStride", 12}};
  if (exponential) {
    meshopt_encodeFilterExp(positions.data(), grid.vertices(), 12, 24, grid.positions.data());
    attributes["filter"] = "EXPONENTIAL";
  }
  compress(made, 0, encoded_vertices(positions.data(), grid.vertices(), 12), attributes);
  const std::size_t count = grid.indices.size();
  std::string bytes(sequence ? meshopt_encodeIndexSequenceBound(count, grid.vertices())
                             : meshopt_encodeIndexBufferBound(count, grid.vertices()),
                    '\0');
  auto* to = reinterpret_cast<unsigned char*>(bytes.data());
  bytes.resize(sequence ? meshopt_encodeIndexSequence(to, bytes.size(), grid.indices.data(), count)
                        : meshopt_encodeIndexBuffer(to, bytes.size(), grid.indices.data(), count));
  compress(made, 1, bytes, {{"mode", sequence ? "INDICES" : "TRIANGLES"}, {"count", count}, {"byteStride", 4}});
  made.json["buffers"] = {
      {{"byteLength", made.buffer.size()}},
      {{"byteLength", 1 << 20}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
  made.json["extensionsRequired"] = {"EXT_meshopt_compression"};
  return made;
}

TEST(ImportGltf, GivesTheTrianglesThatMeshoptCompressed) {
  const TemporaryFolder folder;
  const MadeGrid grid(20);
  const std::vector<Triangle> plain = read(folder, grid.gltf());
  for (const bool exponential : {false, true}) {
    for (const bool sequence : {false, true}) {
      expect_near(read(folder, meshopt_gltf(grid, exponential, sequence)), plain, exponential ? 1e-6 : 0.0);
    }
  }
}

TEST(ImportGltf, RefusesWhatMeshoptCannotDecode) {
  const TemporaryFolder folder;
  const MadeGrid grid(20);
  for (const auto& [key, value] : {std::pair<const char*, Json>{"count", 4'000'000'000u},
                                   {"byteStride", 13},
                                   {"mode", "X"},
                                   {"byteLength", 7},
                                   {"count", -1},
                                   {"filter", "QUATERNION"}}) {
    MadeGltf made = meshopt_gltf(grid, false, false);
    made.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = value;
    const std::string error = import_error(folder.write("bad.glb", made.glb()));
    EXPECT_TRUE(contains(error, "cannot be decompressed") || contains(error, "reaches beyond")) << key << error;
  }
}

TEST(ImportGltf, ScalesQuantizedPositions) {
  const TemporaryFolder folder;
  MadeGltf made;
  const auto points = made.add_accessor(
      packed(std::vector<std::int16_t>{0, 0, 0, 0, 32767, 0, 0, 0, 0, -32767, 16384, 0}), 5122, "VEC3", 3);
  made.json["accessors"][points]["normalized"] = true;
  made.json["bufferViews"][0]["byteStride"] = 8;
  made.json["nodes"][0]["scale"] = {10, 10, 10};
  made.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  made.add_mesh({{"attributes", {{"POSITION", points}}}});
  const Triangle t = read(folder, made).at(0);
  EXPECT_EQ(t[0], Vec3(0, 0, 0));
  EXPECT_EQ(t[1], Vec3(10, 0, 0));
  EXPECT_LT(glm::length(t[2] - Vec3(0, -10.0 * (16384 / 32767.0), -10)), 1e-6);
}

TEST(ImportGltf, RepeatsInstances) {
  const TemporaryFolder folder;
  const MadeGrid grid(1);
  MadeGltf made = grid.gltf();
  const auto moved = made.add_accessor(packed(std::vector<float>{0, 0, 0, 100, 0, 0, 0, 5, 0}), type_f32, "VEC3", 3);
  const auto sizes = made.add_accessor(packed(std::vector<float>{1, 1, 1, 2, 2, 2, 1, 1, 1}), type_f32, "VEC3", 3);
  // By half a turn around y.
  const auto turns =
      made.add_accessor(packed(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0}), type_f32, "VEC4", 3);
  made.json["nodes"][0]["extensions"] = {
      {"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", moved}, {"SCALE", sizes}, {"ROTATION", turns}}}}}};
  const std::vector<Triangle> all = read(folder, made), one = read(folder, grid.gltf());
  ASSERT_EQ(all.size(), 6u);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(all[i][k], one[i][k]);
      EXPECT_EQ(all[2 + i][k], 2.0 * one[i][k] + Vec3(100, 0, 0));
      const Vec3 half_turn(0.0 - one[i][k].x, 0.0 - one[i][k].y, one[i][k].z + 5.0);
      for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(all[4 + i][k][axis], half_turn[axis], 1e-15);
    }
  }
  EXPECT_EQ(import_scene(folder.write("three.glb", made.glb())).meshes.size(), 1u);
}

TEST(ImportGltf, LeavesOutHiddenNodesAndTheirChildren) {
  const TemporaryFolder folder;
  MadeGltf made = MadeGrid(1).gltf();
  made.json["extensionsRequired"] = {"KHR_node_visibility"};
  const auto show = [](bool shown) { return Json{{"KHR_node_visibility", {{"visible", shown}}}}; };
  made.json["nodes"] = {{{"children", {1, 3}}},
                        {{"mesh", 0}, {"children", {2}}, {"extensions", show(false)}},
                        {{"mesh", 0}, {"extensions", show(true)}},
                        {{"mesh", 0}, {"translation", {5, 0, 0}}, {"extensions", show(true)}}};
  const ImportedScene scene = import_scene(folder.write("hidden.glb", made.glb()));
  EXPECT_EQ(scene.report.triangles, 2u);
  EXPECT_EQ(bounds_of(scene).lower.x, 5.0);
  EXPECT_TRUE(scene.report.notes.empty());
}

TEST(ImportGltf, ReadsStripsFansAndSparseAccessors) {
  const TemporaryFolder folder;
  MadeGltf made;
  const auto points =
      made.add_accessor(packed(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 0, -1, 1, 0, -1}), type_f32, "VEC3", 4);
  const auto where = made.add_view(packed(std::vector<std::uint16_t>{3, 0}));
  const auto what = made.add_view(packed(std::vector<float>{7, 0, -7}));
  made.json["accessors"][points]["sparse"] = {{"count", 1},
                                              {"indices", {{"bufferView", where}, {"componentType", type_u16}}},
                                              {"values", {{"bufferView", what}}}};
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(7, 7, 0);
  made.add_mesh({{"attributes", {{"POSITION", points}}}, {"mode", 5}});
  EXPECT_EQ(read(folder, made), (std::vector<Triangle>{{a, b, c}, {b, d, c}}));
  made.json["meshes"][0]["primitives"][0]["mode"] = 6;
  EXPECT_EQ(read(folder, made), (std::vector<Triangle>{{a, b, c}, {a, c, d}}));
  made.json["meshes"][0]["primitives"][0]["mode"] = 1;
  EXPECT_TRUE(contains(import_error(folder.write("lines.glb", made.glb())), "gives no triangle"));
}

TEST(ImportGltf, KeepsTheDigitsOfNodesFarFromZero) {
  const TemporaryFolder folder;
  MadeGltf made = MadeGrid(1).gltf();
  made.json["nodes"][0]["translation"] = {4157222.125, 664789.307, 4774952.099};
  const Triangle far = read(folder, made).at(0), near = read(folder, MadeGrid(1).gltf()).at(0);
  const Vec3 moved = far[1] - near[1];
  EXPECT_NEAR(moved.x, 4157222.125, 1e-6);
  EXPECT_NEAR(moved.z, 664789.307, 1e-6);
  EXPECT_NEAR(moved.y, -4774952.099, 1e-6);
  made = MadeGrid(1).gltf();
  // The centre is upright, unlike the rest of the file.
  made.json["extensions"] = {{"CESIUM_RTC", {{"center", {1e6, 2e6, 3e6}}}}};
  EXPECT_EQ(read(folder, made).at(0)[0] - near[0], Vec3(1e6, 2e6, 3e6));
}

TEST(ImportGltf, PutsCornersOnAGridSoThatObjectsThatMeetShareThem) {
  const TemporaryFolder folder;
  MadeGltf made = MadeGrid(1).gltf();
  const double half = std::sqrt(0.5);
  made.json["nodes"][0]["rotation"] = {half, 0.0, 0.0, half};
  made.json["nodes"][0]["translation"] = {0.1, 0.3, 0.7};
  const Triangle triangle = read(folder, made).at(0);
  for (const Vec3& corner : triangle) {
    for (int k = 0; k < 3; ++k) EXPECT_EQ(std::remainder(corner[k], 0x1p-20), 0.0) << corner[k];
  }
}

TEST(ImportGltf, RefusesDamagedFilesWithASentence) {
  const TemporaryFolder folder;
  const auto error_of = [&](const Json::json_pointer& place, const Json& value) {
    MadeGltf made = MadeGrid(2).gltf();
    made.json["buffers"] = {{{"byteLength", made.buffer.size()}}};
    made.json[place] = value;
    return import_error(folder.write("bad.glb", made.glb()));
  };
  using Pointer = Json::json_pointer;
  EXPECT_TRUE(contains(error_of(Pointer("/nodes/0/children"), {0}), "its node 0 is reached twice"));
  EXPECT_TRUE(contains(error_of(Pointer("/nodes/0/children"), {9}), "'nodes' that is not there"));
  EXPECT_TRUE(contains(error_of(Pointer("/nodes/0/mesh"), 7), "'meshes' that is not there"));
  EXPECT_TRUE(contains(error_of(Pointer("/accessors/0/count"), 4'000'000'000u), "reaches beyond its buffer view"));
  EXPECT_TRUE(contains(error_of(Pointer("/bufferViews/0/byteLength"), 4'000'000'000u), "reaches beyond its buffer"));
  EXPECT_TRUE(contains(error_of(Pointer("/accessors/0/count"), -3), "has no count"));
  EXPECT_TRUE(contains(error_of(Pointer("/buffers/0/uri"), "http://example.org/a.bin"), "is absent or cannot be read"));
  EXPECT_TRUE(contains(error_of(Pointer("/buffers/0/uri"), "../../etc/passwd"), "outside of its folder"));
  MadeGltf made = MadeGrid(1).gltf();
  for (int i = 0; i < 3000; ++i) {
    made.json["nodes"][static_cast<std::size_t>(i)]["children"] = Json::array({i + 1});
  }
  EXPECT_TRUE(contains(import_error(folder.write("deep.glb", made.glb())), "nested more than 2000 deep"));
}

TEST(ImportGltf, CountsOnlyBracketsOutsideStringsAsNesting) {
  const TemporaryFolder folder;
  for (const bool deep : {false, true}) {
    MadeGltf made = MadeGrid(2).gltf();
    made.json["asset"]["copyright"] = "\"\\" + std::string(5000, '[') + "\\\"" + std::string(5000, '{');
    // The whole is an object around it; 64 are allowed.
    const std::size_t depth = deep ? 64 : 63;
    made.json["extras"] = Json::parse(std::string(depth, '[') + "1" + std::string(depth, ']'));
    const std::string file = folder.write("named.glb", made.glb());
    if (deep) {
      EXPECT_TRUE(contains(import_error(file), "its JSON is nested more than")) << import_error(file);
    } else {
      EXPECT_GT(import_scene(file).meshes.size(), 0U);
    }
  }
}

TEST(ImportGltf, ReadsWhatGltfpackWrites) {
  ROAM_NEEDS_TEST_DATA();
  const TemporaryFolder folder;
  const std::string packed_file = (folder.path() / "packed.glb").string();
  const std::filesystem::path house = test_data() / "building/small_house.glb";
  const auto run =
      run_program("/bin/sh", {"-c", "exec gltfpack -c -kn -i '" + house.string() + "' -o '" + packed_file + "'"});
  if (run.status != 0) GTEST_SKIP() << "gltfpack is not installed";
  const std::vector<Triangle> wanted = triangles_of(import_scene(house));
  const ImportedScene small = import_scene(packed_file);
  const std::vector<Triangle> got = triangles_of(small);
  EXPECT_TRUE(small.report.notes.empty());
  // It drops triangles without area.
  EXPECT_GT(got.size(), wanted.size() * 9 / 10);
  EXPECT_LE(got.size(), wanted.size());
  EXPECT_NEAR(area_of(got), area_of(wanted), 1e-3 * area_of(wanted));
  std::set<std::array<long, 3>> corners;
  for (const Triangle& t : wanted) {
    for (const Vec3& corner : t) corners.insert(cell_of(corner));
  }
  // Positions are quantized to 14 bits of the scene's 19 m.
  std::size_t strange = 0;
  for (const Triangle& t : got) {
    for (const Vec3& corner : t) {
      bool known = false;
      for (int i = 0; i < 27 && !known; ++i) {
        known = corners.contains(cell_of(corner, {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1}));
      }
      strange += known ? 0 : 1;
    }
  }
  EXPECT_EQ(strange, 0u);
}

}  // namespace
}  // namespace roam::test
