#include "float_mesh.h"

namespace roam::bench {

FloatMesh::FloatMesh(const Scene& scene) {
  std::size_t vertex_count = 0;
  for (const Mesh& mesh : scene.meshes) vertex_count += mesh.vertices.size();
  vertices.reserve(3 * vertex_count);
  indices.reserve(3 * scene.triangles());
  for (const Mesh& mesh : scene.meshes) {
    const auto first = static_cast<std::uint32_t>(vertices.size() / 3);
    for (const Vec3& v : mesh.vertices) {
      for (int k = 0; k < 3; ++k) vertices.push_back(static_cast<float>(v[k]));
    }
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) indices.push_back(first + corner);
    }
  }
}

}  // namespace roam::bench
