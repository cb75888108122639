#include <fmt/format.h>
#include <xxhash.h>

#include <bit>
#include <memory>
#include <string>

#include "math/floating_point.h"
#include "roam/profile.h"
#include "roam/store.h"
#include "text/printable.h"

namespace roam {

static_assert(std::endian::native == std::endian::little, "the hash is defined over little-endian doubles");

namespace {

void demand_vertices(const Mesh& mesh, std::size_t number, std::size_t triangle) {
  for (const std::uint32_t vertex : mesh.triangles[triangle]) {
    if (vertex < mesh.vertices.size()) continue;
    throw Error(fmt::format(
        "cannot identify the scene: triangle {} of mesh {}{} uses vertex {}, but the mesh has {} "
        "vertices; correct the mesh",
        triangle, number, mesh.name.empty() ? std::string() : fmt::format(" (\"{}\")", printable(mesh.name)), vertex,
        mesh.vertices.size()));
  }
}

}  // namespace

SceneIdentity identity_of(std::span<const Mesh> meshes) {
  const DefaultFloatingPoint guard;
  SceneIdentity identity;
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  XXH3_128bits_reset(state.get());
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const Mesh& mesh = meshes[m];
    identity.triangles += mesh.triangles.size();
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      demand_vertices(mesh, m, i);
      Triangle triangle = mesh.triangle(i);
      for (Vec3& corner : triangle) {
        identity.bounds.include(corner);
        // -0 and 0 are the same coordinate.
        corner += 0.0;
      }
      XXH3_128bits_update(state.get(), triangle.data(), sizeof(triangle));
    }
  }
  const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
  identity.hash = fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
  return identity;
}

SceneIdentity identity_of(const StoreInfo& store) { return {{}, store.geometry_hash, store.triangles, store.bounds}; }

bool Profile::belongs_to(const SceneIdentity& other) const {
  const auto unknown = [](const SceneIdentity& one) { return one.hash.empty() && one.geometry_hash.empty(); };
  if (unknown(scene) || unknown(other)) return false;
  if (!scene.hash.empty() && !other.hash.empty()) return scene.hash == other.hash;
  if (!scene.geometry_hash.empty() && !other.geometry_hash.empty()) return scene.geometry_hash == other.geometry_hash;
  return scene.triangles == other.triangles && scene.bounds.lower == other.bounds.lower &&
         scene.bounds.upper == other.bounds.upper;
}

}  // namespace roam
