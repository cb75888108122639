// Box3D as its user built it: its cast of a rounded point or line against the mesh alone. By design a body stops 5 mm
// inside the surface.

#include <box3d/box3d.h>
#include <box3d/collision.h>

#include <array>
#include <memory>

#include "engine.h"
#include "float_mesh.h"
#include "memory.h"
#include "roam/error.h"

namespace roam::bench {
namespace {

using Mesh3d = std::shared_ptr<b3MeshData>;

b3Vec3 to_box3d(const Vec3& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

Mesh3d mesh_of(FloatMesh triangles) {
  static_assert(sizeof(b3Vec3) == 3 * sizeof(float));
  b3MeshDef def{};
  def.vertices = reinterpret_cast<b3Vec3*>(triangles.vertices.data());
  def.vertexCount = static_cast<int>(triangles.vertices.size() / 3);
  def.indices = reinterpret_cast<std::int32_t*>(triangles.indices.data());
  def.triangleCount = static_cast<int>(triangles.indices.size() / 3);
  b3MeshData* mesh = b3CreateMesh(&def, nullptr, 0);
  if (mesh == nullptr) throw Error("Box3D cannot make this mesh");
  return {mesh, b3DestroyMesh};
}

Answer cast(const b3MeshData& data, const Query& query) {
  const Vec3 half(0.0, 0.0, query.body.half_height);
  const std::array<b3Vec3, 2> axis{to_box3d(query.from - half), to_box3d(query.from + half)};
  const b3Mesh mesh{&data, {1.0F, 1.0F, 1.0F}};
  const b3ShapeCastInput input{
      .proxy = {axis.data(), query.body.half_height == 0 ? 1 : 2, static_cast<float>(query.body.radius)},
      .translation = to_box3d(query.motion),
      .maxFraction = 1.0F,
      .canEncroach = false};
  const b3CastOutput first = b3ShapeCastMesh(&mesh, &input);
  return first.hit ? Answer{true, first.fraction} : Answer{};
}

}  // namespace

Engine make_box3d(const Scene& scene) {
  const b3Version version = b3GetVersion();
  Engine engine{.name = "Box3D " + std::to_string(version.major), .used = "b3ShapeCastMesh, floats"};
  engine.name.append(1, '.').append(std::to_string(version.minor));
  engine.name.append(1, '.').append(std::to_string(version.revision));
  const std::size_t before = allocated_bytes();
  Mesh3d mesh;
  engine.build_one = seconds([&] { mesh = mesh_of(FloatMesh(scene)); });
  engine.bytes = allocated_bytes() - before;
  engine.ask = timed([mesh](const Query& query) { return cast(*mesh, query); });
  return engine;
}

}  // namespace roam::bench
