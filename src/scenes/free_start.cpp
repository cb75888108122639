#include "scenes/free_start.h"

#include <fmt/format.h>

#include "roam/error.h"
#include "roam/world.h"
#include "scenes/triangles_around.h"
#include "store/meshes.h"

namespace roam::app {
namespace {

/// Places to examine, metres around each, and the triangles examined there.
constexpr std::uint64_t places = 16;
constexpr double around = 30.0;
constexpr std::size_t floors_each = 64;
constexpr int columns_each = 8;

/// Bytes for each examined triangle: its corners, again for the index, the index, and its construction.
constexpr std::uint64_t bytes_a_triangle = 400;

[[noreturn]] void fail_to_start(const WalkerSettings& settings) {
  throw Error(
      fmt::format("found no free place for a body of radius {:g} m and height {:g} m; is the up axis right (--up)? "
                  "Else take a smaller body, or lead it with --path",
                  settings.radius, settings.height));
}

}  // namespace

std::size_t indexed_in(std::uint64_t memory) { return static_cast<std::size_t>(memory / bytes_a_triangle); }

Vec3 free_start(const Space& space, const WalkerSettings& settings, Mode mode, std::span<const Vec3> floors,
                const std::function<bool()>& goes_on) {
  if (space.bounds().empty()) throw Error("found no place to start from: the scene is empty");
  constexpr int columns = 32;
  const std::optional<WanderStart> start = wander_start(space, settings, mode, floors, columns, goes_on);
  if (!start) fail_to_start(settings);
  return start->place;
}

Vec3 free_start(const Store& store, std::uint64_t memory, const WalkerSettings& settings, Mode mode,
                const std::function<bool()>& goes_on) {
  const std::size_t most = indexed_in(memory);
  std::optional<WanderStart> best;
  for (const Vec3& place : store.sample(places)) {
    Mesh mesh;
    // A start beside unreadable parts is allowed.
    store::append(mesh, triangles_around(store, place, around, most, [&] { return !goes_on || goes_on(); }).triangles);
    const World world = World::build({&mesh, 1});
    const auto floors = floor_samples({&mesh, 1}, floors_each);
    const auto start = wander_start(world, settings, mode, floors, columns_each, goes_on);
    if (start && (!best || start->room > best->room)) best = start;
  }
  if (!best) fail_to_start(settings);
  return best->place;
}

}  // namespace roam::app
