#include "view/start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "roam/error.h"
#include "roam/wander.h"
#include "roam/world.h"
#include "scenes/free_start.h"
#include "scenes/triangles_around.h"
#include "store/meshes.h"

namespace roam::app {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
// m: radius that is loaded from a store to choose the direction
constexpr double view_limit = 60.0;
constexpr double overview_yaw = 60.0;     // degrees: shows two sides of a building, neither frontally
constexpr double overview_pitch = -30.0;  // degrees

Vec3 direction(double yaw, double pitch) {
  return {std::cos(yaw * degree) * std::cos(pitch * degree), std::sin(yaw * degree) * std::cos(pitch * degree),
          std::sin(pitch * degree)};
}

/// Whether the eye at `eye` sees anything near the middle of its picture.
bool sees_something(const Space& space, const Vec3& eye, double yaw) {
  const Box box = space.bounds();
  const double reach = box.empty() ? 0.0 : std::min(2.0 * glm::length(box.size()), Space::motion_limit);
  for (const double aside : {-20.0, 0.0, 20.0}) {
    for (const double up : {-20.0, 0.0, 20.0}) {
      if (space.first_impact({0.0, 0.0}, eye, reach * direction(yaw + aside, up)).hit) return true;
    }
  }
  return false;
}

/// The view from an eye.
struct View {
  double yaw = 0.0;  ///< degrees, direction in which most is open
  bool anything = false;
};

View look(const Space& space, const Vec3& eye) {
  const double yaw = open_direction(space, eye, Space::motion_limit).yaw;
  return {yaw, sees_something(space, eye, yaw)};
}

/// Whether this is wide land, even if it has a bottom.
bool is_land(const Box& bounds, double room) {
  constexpr double wide = 60.0;  // m, of the sum of eight directions
  constexpr double flat = 0.1;   // height of the land, of its width
  const Vec3 size = bounds.size();
  return room >= wide && size.z < flat * std::min(size.x, size.y);
}

/// `find` returns a start for a body of a mode, or throws Error.
StartPlace start_place(const WalkerSettings& settings, Mode mode, const Box& bounds,
                       const std::function<WanderStart(Mode)>& find,
                       const std::function<View(const Vec3&)>& look_around) {
  StartPlace start;
  start.mode = mode;
  constexpr double fov = 60.0;
  std::string why;
  for (const Mode way : {Mode::walk, Mode::fly}) {
    if (way == Mode::walk && mode != Mode::walk) continue;
    try {
      const WanderStart found = find(way);
      if (found.on_top && !is_land(bounds, found.room)) {
        if (mode == Mode::walk) why = "the scene has no floor with room for this body";
        break;
      }
      const Vec3 centre = found.place;
      if (way != mode && mode == Mode::walk) {
        start.mode = Mode::fly;
        start.note = "There is no floor that this body can stand on: it flies. Is the up axis right (--up)?";
      }
      const View view = look_around(centre + Vec3(0.0, 0.0, settings.eye - 0.5 * settings.height));
      start.pose = {centre, view.yaw, 0.0};
      // A flying body may as well begin with something in view.
      if (start.mode == Mode::fly && !view.anything) start.pose = overview(bounds, fov, settings.height);
      return start;
    } catch (const Error& error) {
      why = error.what();
    }
  }
  start.pose = overview(bounds, fov, settings.height);
  if (mode != Mode::ghost) start.mode = Mode::fly;
  start.note = why.empty() ? why : fmt::format("Outside of the scene, flying: {}", why);
  return start;
}

}  // namespace

Pose overview(const Box& box, double fov, double least) {
  const double radius = box.empty() ? 1.0 : std::max(0.5 * glm::length(box.size()), 1e-3);
  const Vec3 centre = box.empty() ? Vec3(0.0) : box.center();
  const double distance = std::max(radius / std::sin(0.5 * fov * degree), radius + least);
  return {centre - distance * direction(overview_yaw, overview_pitch), overview_yaw, overview_pitch};
}

StartPlace find_start(const Space& space, const WalkerSettings& settings, Mode mode, std::span<const Mesh> meshes,
                      const std::function<bool()>& goes_on) {
  const std::vector<Vec3> floors = floor_samples(meshes);
  return start_place(
      settings, mode, space.bounds(),
      [&](Mode way) { return free_start(space, settings, way, floors, meshes, goes_on); },
      [&](const Vec3& eye) { return look(space, eye); });
}

StartPlace find_start(const Store& store, std::uint64_t memory, const WalkerSettings& settings, Mode mode,
                      const std::function<bool()>& goes_on) {
  return start_place(
      settings, mode, store.info().bounds, [&](Mode way) { return free_start(store, memory, settings, way, goes_on); },
      [&](const Vec3& eye) {
        Mesh mesh;
        store::append(mesh, triangles_around(store, eye, view_limit, indexed_in(memory), goes_on).triangles);
        return look(World::build({&mesh, 1}), eye);
      });
}

}  // namespace roam::app
