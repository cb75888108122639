#include "scenes/free_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "roam/error.h"
#include "roam/world.h"
#include "scenes/solid.h"
#include "scenes/triangles_around.h"
#include "store/meshes.h"

namespace roam::app {
namespace {

/// Places to examine, metres around each, and the triangles examined there.
constexpr std::uint64_t places = 16;
constexpr double around = 30.0;
constexpr std::size_t floors_each = 64;
constexpr int columns_each = 8;

/// A place with a winding number over this is within something solid. Open ground below it takes half a turn away, and
/// a roof that is only a sheet adds less than half a turn.
constexpr double solid = 0.45;
/// Triangles examined for that, in all: about a second.
constexpr std::uint64_t most_examined = 30'000'000;

/// Bytes for each examined triangle: its corners, again for the index, the index, and its construction.
constexpr std::uint64_t bytes_a_triangle = 400;

[[noreturn]] void fail_to_start(const WalkerSettings& settings) {
  throw Error(fmt::format(
      "found no free place for a body of radius {:g} m and height {:g} m; are the up axis and the unit right "
      "(--up, --unit)? Else take a smaller body, or lead it with --path",
      settings.radius, settings.height));
}

/// Whether places are not within anything solid.
class Outside {
 public:
  Outside(const Space& space, std::span<const Mesh> meshes) : space_(space), meshes_(meshes) {
    for (const Mesh& mesh : meshes) triangles_ += mesh.triangles.size();
  }
  bool operator()(const Vec3& place) {
    const double up = std::min(glm::length(space_.bounds().size()), Space::motion_limit);
    if (triangles_ == 0 || !space_.first_impact({0.0, 0.0}, place, {0.0, 0.0, up}).hit) return true;
    examined_ += triangles_;
    // Beyond this much work only a place under the sky counts as outside; in the largest scenes one is examined.
    if (examined_ > std::max(most_examined, triangles_)) return false;
    return winding_number(meshes_, place) < solid;
  }

 private:
  const Space& space_;
  std::span<const Mesh> meshes_;
  std::uint64_t triangles_ = 0, examined_ = 0;
};

}  // namespace

std::size_t indexed_in(std::uint64_t memory) { return static_cast<std::size_t>(memory / bytes_a_triangle); }

WanderStart free_start(const Space& space, const WalkerSettings& settings, Mode mode, std::span<const Vec3> floors,
                       std::span<const Mesh> meshes, const std::function<bool()>& goes_on) {
  if (space.bounds().empty()) throw Error("found no place to start from: the scene is empty");
  constexpr int columns = 32;
  const std::optional<WanderStart> start =
      wander_start(space, settings, mode, floors, columns, goes_on, Outside(space, meshes));
  if (!start) fail_to_start(settings);
  return *start;
}

WanderStart free_start(const Store& store, std::uint64_t memory, const WalkerSettings& settings, Mode mode,
                       const std::function<bool()>& goes_on) {
  const std::size_t most = indexed_in(memory);
  std::optional<WanderStart> best;
  const auto is_better = [&](const WanderStart& start) {
    return !best || (start.on_top != best->on_top ? best->on_top : start.room > best->room);
  };
  for (const Vec3& place : store.sample(places)) {
    Mesh mesh;
    // A start beside unreadable parts is allowed.
    store::append(mesh, triangles_around(store, place, around, most, [&] { return !goes_on || goes_on(); }).triangles);
    const World world = World::build({&mesh, 1});
    const auto floors = floor_samples({&mesh, 1}, floors_each);
    const auto start = wander_start(world, settings, mode, floors, columns_each, goes_on, Outside(world, {&mesh, 1}));
    if (start && is_better(*start)) best = start;
  }
  if (!best) fail_to_start(settings);
  return *best;
}

}  // namespace roam::app
