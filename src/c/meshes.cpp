#include "c/meshes.h"

#include <cstring>
#include <string>

#include "c/structs.h"
#include "process/free_memory.h"

namespace roam::c {
namespace {

/// Element i of an array with a stride in bytes; 0: packed.
template <class T>
T element(const void* data, std::ptrdiff_t stride, std::size_t i) {
  T value;
  const std::ptrdiff_t step = stride != 0 ? stride : static_cast<std::ptrdiff_t>(sizeof(T));
  std::memcpy(&value, static_cast<const char*>(data) + static_cast<std::ptrdiff_t>(i) * step, sizeof(T));
  return value;
}

Mesh copy(const roam_mesh& from) {
  if (from.vertex_count > 0) (void)needed(from.vertices, "roam_mesh::vertices");
  if (from.triangle_count > 0) (void)needed(from.triangles, "roam_mesh::triangles");
  Mesh mesh;
  if (from.name != nullptr) mesh.name = from.name;
  mesh.vertices.resize(from.vertex_count);
  for (std::size_t i = 0; i < from.vertex_count; ++i)
    mesh.vertices[i] = element<Vec3>(from.vertices, from.vertex_stride, i);
  mesh.triangles.resize(from.triangle_count);
  for (std::size_t i = 0; i < from.triangle_count; ++i)
    mesh.triangles[i] = element<std::array<std::uint32_t, 3>>(from.triangles, from.triangle_stride, i);
  return mesh;
}

}  // namespace

std::vector<Mesh> copied(const roam_mesh* meshes, std::size_t count, std::size_t bytes_a_triangle) {
  if (count > 0) (void)needed(meshes, "the array of meshes");
  std::vector<roam_mesh> all;
  double bytes = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back(given(at(meshes, i), "roam_mesh"));
    bytes += static_cast<double>(all.back().vertex_count) * sizeof(Vec3) +
             static_cast<double>(all.back().triangle_count) * (sizeof(std::array<std::uint32_t, 3>) + bytes_a_triangle);
  }
  // The system would let a process have it, and end some process later.
  if (const auto free = process::free_memory(); free && bytes > static_cast<double>(*free)) throw std::bad_alloc();
  std::vector<Mesh> result;
  for (const roam_mesh& mesh : all) result.push_back(copy(mesh));
  return result;
}

std::vector<Mesh> imported(const char* path, const roam_world_options& options, Progress& progress) {
  ImportOptions how;
  about_arguments([&] {
    if (options.up != nullptr) how.up = parse_up_axis(options.up);
    if (options.unit != nullptr) how.unit = parse_length_unit(options.unit);
  });
  how.progress = [&](const ImportProgress&) { return progress.goes_on(0.0); };
  return import_scene(path, how).meshes;
}

}  // namespace roam::c
