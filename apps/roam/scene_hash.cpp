#include "scene_hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <bit>
#include <memory>

namespace roam::app {

static_assert(std::endian::native == std::endian::little, "the hash is defined over little-endian doubles");

std::string scene_hash(std::span<const Mesh> meshes) {
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  XXH3_128bits_reset(state.get());
  for (const Mesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      Triangle triangle = mesh.triangle(i);
      // -0 and 0 are one place.
      for (Vec3& corner : triangle) corner += 0.0;
      XXH3_128bits_update(state.get(), triangle.data(), sizeof(triangle));
    }
  }
  const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace roam::app
