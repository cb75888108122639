#include "store_start.h"

#include "floors.h"
#include "loose_triangles.h"
#include "roam/world.h"

namespace roam::app {
namespace {

/// Places that are looked at, metres around each, and triangles in all.
constexpr std::uint64_t places = 16;
constexpr double around = 30.0;
constexpr std::size_t most_triangles = 4'000'000;

}  // namespace

Vec3 store_start(const Store& store, const WalkerSettings& settings, Mode mode, const std::function<bool()>& goes_on) {
  std::vector<Mesh> meshes;
  std::size_t triangles = 0;
  for (const Vec3& place : store.sample(places)) {
    if (goes_on && !goes_on()) throw Cancelled();
    if (triangles > most_triangles) break;
    Mesh mesh;
    // Where something cannot be read one may still begin beside it.
    store.for_each_triangle(
        {place - around, place + around},
        [&](std::span<const Triangle> found, std::span<const TriangleId>) { append(mesh, found); },
        [](const std::string&) {});
    triangles += mesh.triangles.size();
    meshes.push_back(std::move(mesh));
  }
  const World world = World::build(meshes);
  return wander_start(world, settings, mode, floor_samples(meshes), goes_on);
}

}  // namespace roam::app
