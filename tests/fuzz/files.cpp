// OBJ, STL and PLY, read in this process: a scene or a message, whole and in pieces the same.
#include <fcntl.h>

#include "reading.h"

namespace fuzz {
namespace {

/// Reads the file in all ways.
void run_file(const std::string& name, Bytes input) {
  static const Stream stream;
  const std::string file = write(name, text_of(input));
  const auto read = [&](Wanted wanted) {
    stream.clear();
    read_to(stream, file, wanted);
    return taken(stream.bytes(), wanted);
  };
  const Outcome meshes = read(Wanted::meshes), pieces = read(Wanted::pieces), display = read(Wanted::display);
  demand(meshes.error.empty() == pieces.error.empty(), "only one of the whole scene and its pieces is read");
  if (!meshes.error.empty()) return;
  demand(meshes.triangles == pieces.triangles && meshes.corners == pieces.corners, "pieces of another scene");
  demand(display.error.empty() && display.triangles == meshes.triangles, "other triangles are shown");
}

void run_obj(Bytes input) { run_file("scene.obj", input); }
void run_stl(Bytes input) { run_file("scene.stl", input); }
void run_ply(Bytes input) { run_file("scene.ply", input); }

template <class... T>
std::string packed_values(T... values) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&values), sizeof(values)), ...);
  return bytes;
}

std::vector<std::string> obj_seeds() {
  return {
      "# a wall\nmtllib a.mtl\no wall\nv 0 0 0\nv 1 0 0 1 0 0\nv 1.5e0 1 0\nv 0 1 -0.25\nvt 0 0\nvn 0 0 1\nusemtl a\nf "
      "1 2 3 "
      "4\ng door\nf -4//1 -3/1/1 -2\n",
      "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3\nl 1 2\np 1\ns off\nf 3 2 9\n"};
}

std::vector<std::string> stl_seeds() {
  std::string binary(80, 'x');
  binary += packed_values(std::uint32_t{2});
  for (int i = 0; i < 2; ++i) {
    binary +=
        packed_values(0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 1.0f * i, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, std::uint16_t{0});
  }
  return {
      "solid wall\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1e0 "
      "0\nendloop\nendfacet\nendsolid "
      "wall\nsolid door\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
      "endsolid\n",
      binary};
}

std::vector<std::string> ply_seeds() {
  const std::string vertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string corners = packed_values(0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f);
  std::string turned;  // in the other order of bytes
  for (std::size_t i = 0; i < corners.size(); i += 4)
    turned += {corners[i + 3], corners[i + 2], corners[i + 1], corners[i]};
  return {
      "ply\nformat ascii 1.0\ncomment a wall\nobj_info x\n" + vertices +
          "property uchar red\nproperty uchar green\nproperty uchar blue\n" + faces +
          "0 0 0 9 9 9\n1 0 0 9 9 9\n0 1 0 9 9 9\n3 0 1 2\n",
      "ply\nformat binary_little_endian 1.0\n" + vertices + faces + corners + '\3' +
          packed_values(std::int32_t{0}, std::int32_t{1}, std::int32_t{2}),
      "ply\nformat binary_big_endian 1.0\n" + vertices + faces + turned + std::string("\3\0\0\0\0\0\0\0\1\0\0\0\2", 13),
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\nelement "
      "tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n4 0 1 2 3\n"};
}

const Known obj_target({"obj",
                        run_obj,
                        obj_seeds,
                        {"usemtl ", "mtllib ", "\nf ", "\nv ", "\nvt ", "\nvn ", "\ng ", "\no ", "//", "\\\n", "-1",
                         "1e309", "4294967296", "nan"}});
const Known stl_target({"stl",
                        run_stl,
                        stl_seeds,
                        {"solid ", "endsolid", "facet normal ", "outer loop", "vertex ", "endloop", "endfacet", "1e309",
                         "nan"}});
const Known ply_target({"ply",
                        run_ply,
                        ply_seeds,
                        {"element vertex ", "element face ", "element tristrips ", "property list uchar int ",
                         "property list int uint ", "property double ", "property uchar red", "vertex_indices",
                         "end_header\n", "format binary_little_endian 1.0", "format ascii 1.0", "comment ",
                         "4294967295", "-1", "nan", "1e309"}});

}  // namespace
}  // namespace fuzz
